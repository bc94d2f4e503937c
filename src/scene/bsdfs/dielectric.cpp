#include "scene/bsdfs/dielectric.h"

#include "materials/materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer DielectricMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const DielectricOptions o{b.slot(eta), b.slot(specular_reflectance),
                            b.slot(specular_transmittance)};
  if (roughness) return std::make_unique<RoughDielectric>(o, b.roughness(*roughness));
  return std::make_unique<Dielectric>(o);
}

MaterialPointer ThinDielectricMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<ThinDielectric>(DielectricOptions{
      {float(eta)}, b.slot(specular_reflectance), b.slot(specular_transmittance)});
}

}  // namespace duet
