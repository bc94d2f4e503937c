#include "scene/bsdfs/layers.h"

#include "materials/coating.h"
#include "materials/special_materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer CoatingMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  CoatingOptions o{float(eta), float(thickness), b.slot(sigma_a), b.slot(specular_reflectance),
                   std::nullopt};
  if (roughness) o.roughness = b.roughness(*roughness);
  const Material* base = b.material(nested);
  return base ? std::make_unique<Coating>(o, *base) : nullptr;
}

MaterialPointer ThinLayerMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<ThinLayer>(
      ThinLayerOptions{b.slot(sigma_s), b.slot(sigma_a), float(thickness), float(g)});
}

}  // namespace duet
