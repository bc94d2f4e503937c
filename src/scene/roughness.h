// The roughness of an interface between two materials, as several BSDFs have it.
#pragma once

#include "materials/microfacet_kind.h"
#include "scene/description_base.h"
#include "scene/field.h"

namespace duet {

namespace parameter_words {
inline constexpr Parameter kDistribution{
    "distribution", string, "beckmann",
    "beckmann or ggx; ggx_correlated is Duet's own (the masking of pbrt); phong and as of 0.x are "
    "approximated by beckmann"};
inline constexpr Parameter kAlpha{"alpha", number_or_texture, "0.1",
                                  "roughness in both directions"};
inline constexpr Parameter kAlphaU{"alpha_u", number_or_texture, "", "roughness along the tangent"};
inline constexpr Parameter kAlphaV{"alpha_v", number_or_texture, "",
                                   "roughness along the bitangent"};
inline constexpr Parameter kSampleVisible{"sample_visible", boolean, "true",
                                          "sample only the normals that can be seen"};
}  // namespace parameter_words

/// A rough interface; absent where the interface is smooth.
struct Roughness {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  FloatInput alpha_u = 0.1, alpha_v = 0.1;
  bool sample_visible = true;

  /// Without parameters: together they are one field of a BSDF.
  static constexpr auto fields() {
    return plain_fields(&Roughness::distribution, &Roughness::alpha_u, &Roughness::alpha_v,
                        &Roughness::sample_visible);
  }
};

/// The field of a BSDF whose interface is always, or sometimes, rough.
template <class T, class R>
constexpr auto roughness_field(R T::*member) {
  using namespace parameter_words;
  return field(member, kDistribution, kAlpha, kAlphaU, kAlphaV, kSampleVisible);
}
/// The same where alpha_v equals alpha_u.
template <class T, class R>
constexpr auto isotropic_roughness_field(R T::*member) {
  using namespace parameter_words;
  return field(member, kDistribution, kAlpha, kSampleVisible);
}

}  // namespace duet
