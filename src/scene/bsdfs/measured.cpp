#include "scene/bsdfs/measured.h"

#include "materials/special_materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer MeasuredMaterial::build(SceneBuilder&, const SourceLocation&) const {
  return std::make_unique<Measured>(table);
}

}  // namespace duet
