#include "materials/thin_layer.h"

#include "materials/henyey_greenstein.h"
#include "materials/special_materials.h"

namespace duet {

namespace {

/// ∫₀^τ exp(−t/a − s(t)/b) dt / a with s(t) = t for reflection, τ − t for transmission: the light
/// that is scattered on the way in at depth t (a: cosine of the view, b: of the light).
float scattered(float depth, float a, float b, bool reflection) {
  if (reflection) return b / (a + b) * -std::expm1(-depth * (1 / a + 1 / b));
  const float difference = depth * (1 / a - 1 / b);
  // (1 − exp(−x)) / x, with its limit.
  const float mean =
      std::abs(difference) < 1e-4f ? 1 - 0.5f * difference : -std::expm1(-difference) / difference;
  // Of the two exponentials the one that does not overflow.
  return difference >= 0 ? std::exp(-depth / b) * mean * depth / a
                         : std::exp(-depth / a) * depth / a *
                               (std::abs(difference) < 1e-4f ? 1 + 0.5f * difference
                                                             : std::expm1(difference) / difference);
}

}  // namespace

Spectrum ThinLayerModel::straight_through(const Vector3f& wo) const {
  const float inverse = 1 / std::max(std::abs(wo.z), 1e-6f);
  return {std::exp(-depth.r * inverse), std::exp(-depth.g * inverse), std::exp(-depth.b * inverse)};
}

ModelEval ThinLayerModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  const float a = std::abs(wo.z), b = std::abs(wi.z);
  if (!(a > 1e-6f && b > 1e-6f) || !has_smooth()) return {};
  const float phase = henyey_greenstein(-dot(wo, wi), g);
  const bool reflection = wo.z * wi.z > 0;
  const Spectrum once(scattered(depth.r, a, b, reflection), scattered(depth.g, a, b, reflection),
                      scattered(depth.b, a, b, reflection));
  return {albedo * once * phase, phase * (1 - straight_through(wo).mean())};
}

std::optional<ModelSample> ThinLayerModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                                  Transport transport) const {
  if (!(std::abs(wo.z) > 1e-6f)) return std::nullopt;
  const Spectrum straight = straight_through(wo);
  const float p = straight.mean();
  if (u < p)
    return ModelSample{
        .wi = -wo, .weight = straight * (1 / p), .pdf = p, .delta = true, .null = true};
  const Vector3f wi = sample_henyey_greenstein(-wo, g, v);
  return sample_from(eval(wo, wi, transport), wi);
}

ThinLayer::ThinLayer(const ThinLayerOptions& options) : options_(options) {
  if (all_constant(options.sigma_s, options.sigma_a)) set_constant(model({}));
}

ThinLayerModel ThinLayer::model(const Surface& s) const {
  const Spectrum scattering = options_.sigma_s(s), sum = scattering + options_.sigma_a(s);
  Spectrum albedo;
  for (int c = 0; c < 3; ++c) albedo[c] = sum[c] > 0 ? scattering[c] / sum[c] : 0.0f;
  return {albedo, sum * options_.thickness, options_.g};
}

SurfaceNeeds ThinLayer::needs() const {
  return {.uv = any_needs_uv(options_.sigma_s, options_.sigma_a)};
}

}  // namespace duet
