#include "scene/bsdfs/principled.h"

#include "materials/principled_materials.h"
#include "scene/builder.h"

namespace duet {

namespace {

/// What "principled" and "principledthin" have in common.
template <class Options, class Description>
Options principled_options(SceneBuilder& b, const Description& m) {
  Options o;
  o.base_color = b.slot(m.base_color);
  o.roughness = b.slot(m.roughness);
  o.anisotropic = b.slot(m.anisotropic);
  o.spec_trans = b.slot(m.spec_trans);
  o.spec_tint = b.slot(m.spec_tint);
  o.sheen = b.slot(m.sheen);
  o.sheen_tint = b.slot(m.sheen_tint);
  o.flatness = b.slot(m.flatness);
  o.diffuse_reflectance_sampling_rate = float(m.diffuse_reflectance_sampling_rate);
  return o;
}

bool is_used(const FloatInput& weight) {
  return weight != FloatInput(0.0);
}

}  // namespace

Scattering PrincipledMaterial::scattering() const {
  return {.diffuse = true, .rough_reflection = true, .rough_refraction = is_used(spec_trans)};
}

MaterialPointer PrincipledMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  auto o = principled_options<PrincipledOptions>(b, *this);
  o.metallic = b.slot(metallic);
  o.eta = specular ? principled_eta(float(*specular), is_used(o.spec_trans)) : float(eta);
  o.clearcoat = b.slot(clearcoat);
  o.clearcoat_gloss = b.slot(clearcoat_gloss);
  o.main_specular_sampling_rate = float(main_specular_sampling_rate);
  o.clearcoat_sampling_rate = float(clearcoat_sampling_rate);
  return std::make_unique<Principled>(o);
}

Scattering PrincipledThinMaterial::scattering() const {
  return {.diffuse = true,
          .rough_reflection = true,
          .rough_refraction = is_used(spec_trans),
          .translucent = true};
}

MaterialPointer PrincipledThinMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  auto o = principled_options<PrincipledThinOptions>(b, *this);
  o.eta = b.slot(eta);
  o.diff_trans = b.slot(diff_trans);
  o.spec_reflectance_sampling_rate = float(spec_reflectance_sampling_rate);
  o.spec_transmittance_sampling_rate = float(spec_transmittance_sampling_rate);
  o.diffuse_transmittance_sampling_rate = float(diffuse_transmittance_sampling_rate);
  return std::make_unique<PrincipledThin>(o);
}

}  // namespace duet
