#include "materials/rough_diffuse.h"

#include "materials/fresnel.h"
#include "materials/materials.h"
#include "math/warp.h"

namespace duet {

ModelEval RoughDiffuseModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const float pdf = wi.z * kInvPi;
  const float sin_o = safe_sqrt(1 - wo.z * wo.z), sin_i = safe_sqrt(1 - wi.z * wi.z);
  // Of the azimuths' difference; it does not matter where one direction has none.
  const float both = sin_o * sin_i;
  const float cos_phi =
      both > 1e-8f ? std::clamp((wo.x * wi.x + wo.y * wi.y) / both, -1.0f, 1.0f) : 0.0f;
  // α is the larger angle to the normal, β the smaller one.
  const bool o_is_lower = wo.z < wi.z;
  const float sin_alpha = o_is_lower ? sin_o : sin_i;
  const float tan_beta = o_is_lower ? sin_i / wi.z : sin_o / wo.z;
  const float c1 = 1 - 0.5f * sigma2 / (sigma2 + 0.33f), b = 0.45f * sigma2 / (sigma2 + 0.09f);
  if (fast)
    return {reflectance * (pdf * (c1 + b * std::max(cos_phi, 0.0f) * sin_alpha * tan_beta)), pdf};
  const float theta_o = std::acos(std::min(wo.z, 1.0f)), theta_i = std::acos(std::min(wi.z, 1.0f));
  const float alpha = std::max(theta_o, theta_i), beta = std::min(theta_o, theta_i);
  const float turn = 2 * beta * kInvPi;
  const float c2 = b * (cos_phi >= 0 ? sin_alpha : sin_alpha - turn * turn * turn);
  const float c3 = 0.125f * sigma2 / (sigma2 + 0.09f) * sqr(4 * alpha * beta * kInvPi * kInvPi);
  const float once =
      c1 + cos_phi * c2 * tan_beta + (1 - std::abs(cos_phi)) * c3 * std::tan(0.5f * (alpha + beta));
  const float twice = 0.17f * sigma2 / (sigma2 + 0.13f) * (1 - cos_phi * turn * turn);
  return {reflectance * (Spectrum(once) + reflectance * twice) * pdf, pdf};
}

std::optional<ModelSample> RoughDiffuseModel::sample(const Vector3f& wo, float, const Point2f& v,
                                                     Transport transport) const {
  const Vector3f wi = square_to_cosine_hemisphere(v);
  return sample_from(eval(wo, wi, transport), wi);
}

RoughDiffuse::RoughDiffuse(const ColorSlot& reflectance, const FloatSlot& alpha, bool fast)
    : reflectance_(reflectance), alpha_(alpha), fast_(fast) {
  if (all_constant(reflectance, alpha)) set_constant(model({}));
}

RoughDiffuseModel RoughDiffuse::model(const Surface& s) const {
  // The roughness of a Beckmann distribution is √2 times the deviation of its slopes.
  return {reflectance_(s), 0.5f * sqr(alpha_(s)), fast_};
}

SurfaceNeeds RoughDiffuse::needs() const {
  return {.uv = any_needs_uv(reflectance_, alpha_)};
}

}  // namespace duet
