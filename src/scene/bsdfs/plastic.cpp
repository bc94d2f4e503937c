#include "scene/bsdfs/plastic.h"

#include "materials/special_materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer PlasticMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const PlasticOptions o{float(eta), b.slot(diffuse_reflectance), b.slot(specular_reflectance),
                         nonlinear};
  if (roughness) return std::make_unique<RoughPlastic>(o, b.roughness(*roughness));
  return std::make_unique<Plastic>(o);
}

MaterialPointer PolarizedPlasticMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const PlasticOptions o{float(eta), b.slot(diffuse_reflectance), b.slot(specular_reflectance)};
  return std::make_unique<PolarizedPlastic>(o, b.roughness(interface));
}

}  // namespace duet
