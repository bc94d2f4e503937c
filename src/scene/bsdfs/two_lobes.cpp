#include "scene/bsdfs/two_lobes.h"

#include "materials/materials.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer PhongMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<Phong>(
      PhongOptions{b.slot(diffuse_reflectance), b.slot(specular_reflectance), b.slot(exponent)});
}

MaterialPointer WardMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<Ward>(WardOptions{b.slot(diffuse_reflectance),
                                            b.slot(specular_reflectance), b.slot(alpha_u),
                                            b.slot(alpha_v), variant});
}

}  // namespace duet
