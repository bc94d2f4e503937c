#include "materials/coated_diffuse.h"

#include "math/warp.h"

namespace duet {

Spectrum coated_base(const Spectrum& reflectance, float returned, float eta, int max_depth) {
  const int terms = (max_depth + 1) / 2;
  const auto sum = [&](float rho) {
    const float q = rho * returned;
    const float series =
        std::abs(1 - q) > 1e-4f ? (1 - std::pow(q, float(terms))) / (1 - q) : float(terms);
    return rho * series / (eta * eta);
  };
  return {sum(reflectance.r), sum(reflectance.g), sum(reflectance.b)};
}

float CoatedDiffuseModel::coat_probability(float cosine, float passed) const {
  const float c = fresnel_dielectric(cosine, eta).reflectance, b = passed * base_weight;
  return c + b > 0 ? c / (c + b) : 0.0f;
}

float CoatedDiffuseModel::nearly_specular_share() const {
  if (smooth || !coat.is_nearly_specular()) return 0;
  return coat_probability(1, row(1));
}

ModelEval CoatedDiffuseModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const float to = passed(wo.z), ti = passed(wi.z);
  const float p = coat_probability(wo.z, to), cosine = wi.z * kInvPi;
  const Spectrum scattered = base * (cosine * to * ti);
  if (smooth) return {scattered, (1 - p) * cosine};
  const Microfacet::Reflection r = coat.reflection(wo, wi);
  const float f = fresnel_dielectric(r.cosine, eta).reflectance;
  return {scattered + Spectrum(f * r.value), p * r.density + (1 - p) * cosine};
}

std::optional<ModelSample> CoatedDiffuseModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                                      Transport transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  const float p = coat_probability(wo.z, passed(wo.z));
  const bool off_coat = u < p;
  if (off_coat && smooth) {
    const float f = fresnel_dielectric(wo.z, eta).reflectance;
    return ModelSample{.wi = reflect(wo), .weight = Spectrum(f / p), .pdf = p, .delta = true};
  }
  const Vector3f wi = off_coat ? reflect(wo, coat.sample(wo, v)) : square_to_cosine_hemisphere(v);
  return sample_from(eval(wo, wi, transport), wi);
}

}  // namespace duet
