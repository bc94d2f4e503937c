#include "scene/bsdfs/sums.h"

#include "materials/pbrt_materials.h"
#include "scene/builder.h"

namespace duet {

namespace {

bool is_anything_but(const ColorInput& input, float value) {
  const Spectrum* constant = std::get_if<Spectrum>(&input);
  return !constant || !(*constant == Spectrum(value));
}

}  // namespace

Scattering UberMaterial::scattering() const {
  const bool refracts = is_anything_but(specular_transmittance, 0);
  return {.diffuse =
              is_anything_but(diffuse_reflectance, 0) || is_anything_but(diffuse_transmittance, 0),
          .rough_reflection = is_anything_but(glossy_reflectance, 0),
          .rough_refraction = is_anything_but(glossy_transmittance, 0),
          .mirror = is_anything_but(specular_reflectance, 0) && !refracts,
          .smooth_glass = refracts,
          .see_through = is_anything_but(opacity, 1),
          .translucent = is_anything_but(diffuse_transmittance, 0)};
}

MaterialPointer UberMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<Uber>(UberOptions{
      b.slot(diffuse_reflectance), b.slot(diffuse_transmittance), b.slot(glossy_reflectance),
      b.slot(glossy_transmittance), b.slot(specular_reflectance), b.slot(specular_transmittance),
      b.slot(opacity), b.slot(eta), b.roughness(roughness)});
}

MaterialPointer SubstrateMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  return std::make_unique<Substrate>(b.slot(diffuse_reflectance), b.slot(specular_reflectance),
                                     b.roughness(roughness));
}

}  // namespace duet
