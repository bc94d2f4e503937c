#include "materials/fresnel_blend.h"

#include "materials/fresnel.h"
#include "materials/pbrt_materials.h"

namespace duet {

float FresnelBlendModel::nearly_specular_share() const {
  if (!microfacet.is_nearly_specular()) return 0;
  const float s = specular.mean(), d = diffuse.mean() * (1 - s);
  return s + d > 0 ? s / (s + d) : 0.0f;
}

ModelEval FresnelBlendModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const auto passed = [](float cosine) { return 1 - schlick_weight(0.5f * cosine); };
  const Spectrum base =
      diffuse * (Spectrum(1) - specular) * (28 / (23 * kPi) * passed(wo.z) * passed(wi.z));
  const Vector3f sum = wo + wi;
  const Vector3f h = normalize(sum);
  const float cosine = 0.5f * length(sum);  // wi · h
  const Spectrum fresnel = specular + (Spectrum(1) - specular) * schlick_weight(cosine);
  const float facets = microfacet.density(h) / (4 * cosine * std::max(wo.z, wi.z));
  const float p = specular_probability();
  return {(base + fresnel * facets) * wi.z,
          p * microfacet.reflection(wo, wi).density + (1 - p) * wi.z * kInvPi};
}

std::optional<ModelSample> FresnelBlendModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                                     Transport transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  const Vector3f wi = u < specular_probability() ? reflect(wo, microfacet.sample(wo, v))
                                                 : square_to_cosine_hemisphere(v);
  return sample_from(eval(wo, wi, transport), wi);
}

Substrate::Substrate(const ColorSlot& diffuse, const ColorSlot& specular,
                     const RoughnessOptions& roughness)
    : diffuse_(diffuse), specular_(specular), roughness_(roughness) {
  if (all_constant(diffuse, specular, roughness.alpha_u, roughness.alpha_v))
    set_constant(model({}));
}

FresnelBlendModel Substrate::model(const Surface& s) const {
  const auto clamp = [](const Spectrum& c) {
    return Spectrum(std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f),
                    std::clamp(c.b, 0.0f, 1.0f));
  };
  return {clamp(diffuse_(s)), clamp(specular_(s)), roughness_(s)};
}

SurfaceNeeds Substrate::needs() const {
  return roughness_.needs() | SurfaceNeeds{.uv = any_needs_uv(diffuse_, specular_)};
}

}  // namespace duet
