#include "media/phase_functions.h"

#include "math/warp.h"

namespace duet {

namespace {

constexpr float kInv4Pi = 0.25f * kInvPi;

float deflection_cosine(const Vector3f& wo, const Vector3f& wi) {
  return -dot(wo, wi);
}

}  // namespace

Vector3f deflected(const Vector3f& wo, float cosine, float u) {
  const Frame frame(Normal3f(-wo));
  const float sine = safe_sqrt(1 - cosine * cosine);
  float s, c;
  sincos_turns(u, s, c);
  return frame.to_world({sine * c, sine * s, cosine});
}

PdfW Isotropic::eval(const Point3f&, const Vector3f&, const Vector3f&) const {
  return {kInv4Pi};
}

PhaseSample Isotropic::sample(const Point3f&, const Vector3f&, float, const Point2f& v) const {
  return {square_to_sphere(v), {kInv4Pi}};
}

PdfW HenyeyGreenstein::density(float cosine) const {
  const float d = 1 + g_ * g_ - 2 * g_ * cosine;
  return {kInv4Pi * (1 - g_ * g_) / (d * std::sqrt(d))};
}

PdfW HenyeyGreenstein::eval(const Point3f&, const Vector3f& wo, const Vector3f& wi) const {
  return density(deflection_cosine(wo, wi));
}

PhaseSample HenyeyGreenstein::sample(const Point3f&, const Vector3f& wo, float,
                                     const Point2f& v) const {
  float cosine = 1 - 2 * v.y;
  if (std::abs(g_) > 1e-3f) {
    const float s = (1 - g_ * g_) / (1 + g_ * cosine);
    cosine = std::clamp((1 + g_ * g_ - s * s) / (2 * g_), -1.0f, 1.0f);
  }
  return {deflected(wo, cosine, v.x), density(cosine)};
}

PdfW Rayleigh::eval(const Point3f&, const Vector3f& wo, const Vector3f& wi) const {
  const float c = deflection_cosine(wo, wi);
  return {0.75f * kInv4Pi * (1 + c * c)};
}

/// Source: Frisvad, "Importance sampling the Rayleigh phase function", 2011.
PhaseSample Rayleigh::sample(const Point3f& p, const Vector3f& wo, float, const Point2f& v) const {
  const float z = 2 * (2 * v.y - 1), root = std::sqrt(z * z + 1);
  const float a = std::cbrt(root + std::abs(z));
  const float cosine = std::clamp(std::copysign(a - 1 / a, z), -1.0f, 1.0f);
  const Vector3f wi = deflected(wo, cosine, v.x);
  return {wi, eval(p, wo, wi)};
}

Tabulated::Tabulated(std::span<const double> values) {
  std::vector<float> weights;
  double integral = 0;  // over the cosine
  const double width = 2 / double(values.size() - 1);
  for (size_t i = 0; i + 1 < values.size(); ++i) {
    weights.push_back(float(values[i] + values[i + 1]));
    integral += 0.5 * (values[i] + values[i + 1]) * width;
  }
  for (const double v : values) density_.push_back(float(v / (integral * 2 * double(kPi))));
  intervals_ = DiscreteDistribution(weights);
}

PdfW Tabulated::eval(const Point3f&, const Vector3f& wo, const Vector3f& wi) const {
  const float x = 0.5f * (deflection_cosine(wo, wi) + 1) * float(density_.size() - 1);
  const size_t i = std::min(size_t(std::max(x, 0.0f)), density_.size() - 2);
  return {lerp(density_[i], density_[i + 1], std::clamp(x - float(i), 0.0f, 1.0f))};
}

PhaseSample Tabulated::sample(const Point3f&, const Vector3f& wo, float, const Point2f& v) const {
  const auto pick = intervals_.sample(v.y, v);
  const float a = density_[pick.index], b = density_[pick.index + 1];
  const float f = sample_linear(pick.remapped, a, b);
  const float cosine =
      std::clamp(2 * (float(pick.index) + f) / float(density_.size() - 1) - 1, -1.0f, 1.0f);
  return {deflected(wo, cosine, v.x), {lerp(a, b, f)}};
}

PdfW BlendedPhase::eval(const Point3f& p, const Vector3f& wo, const Vector3f& wi) const {
  const float w = std::clamp(weight_(p), 0.0f, 1.0f);
  return {(1 - w) * first_.eval(p, wo, wi).value + w * second_.eval(p, wo, wi).value};
}

PhaseSample BlendedPhase::sample(const Point3f& p, const Vector3f& wo, float u,
                                 const Point2f& v) const {
  const float w = std::clamp(weight_(p), 0.0f, 1.0f);
  const bool second = u < w;
  const float rest = second ? u / w : (u - w) / (1 - w);
  PhaseSample s = (second ? second_ : first_).sample(p, wo, std::min(rest, kBelowOne), v);
  if (!(s.pdf.value > 0)) return s;
  const PdfW other = (second ? first_ : second_).eval(p, wo, s.wi);
  s.pdf.value =
      second ? w * s.pdf.value + (1 - w) * other.value : (1 - w) * s.pdf.value + w * other.value;
  return s;
}

}  // namespace duet
