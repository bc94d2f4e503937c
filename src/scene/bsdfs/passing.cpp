#include "scene/bsdfs/passing.h"

#include "materials/special_materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer NullMaterial::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<Null>();
}

MaterialPointer FilterMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<Filter>(b.slot(transmittance),
                                  kind == FilterKindOfLight::retarder ? 1.0f : 0.5f,
                                  kind == FilterKindOfLight::circular);
}

}  // namespace duet
