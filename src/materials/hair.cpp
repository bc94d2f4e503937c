#include "materials/hair.h"

#include "materials/fresnel.h"
#include "materials/hair_absorption.h"
#include "materials/special_materials.h"
#include "math/warp.h"

namespace duet {

namespace {

/// exp(−x) I₀(x) for x ≥ 0, with an error below 3e-7. Source: Abramowitz & Stegun, "Handbook of
/// Mathematical Functions", 9.8.1 and 9.8.2.
float scaled_bessel_i0(float x) {
  if (x <= 3.75f) {
    const float t = sqr(x / 3.75f);
    const float sum =
        1 + t * (3.5156229f +
                 t * (3.0899424f +
                      t * (1.2067492f + t * (0.2659732f + t * (0.0360768f + t * 0.0045813f)))));
    return sum * std::exp(-x);
  }
  const float t = 3.75f / x;
  const float sum =
      0.39894228f +
      t * (0.01328592f +
           t * (0.00225319f +
                t * (-0.00157565f +
                     t * (0.00916281f +
                          t * (-0.02057706f +
                               t * (0.02635537f + t * (-0.01647633f + t * 0.00392377f)))))));
  return sum / std::sqrt(x);
}

/// The distribution M over latitudes, per solid angle of a full turn: its integral over the sphere
/// is 2π. Source: d'Eon et al. 2011, equation 7.
float longitudinal(float sin_from, float cos_from, float sin_to, float cos_to, float variance) {
  const float inverse = 1 / variance;
  const float a = cos_from * cos_to * inverse, b = sin_from * sin_to * inverse;
  return scaled_bessel_i0(a) * std::exp(a - b - inverse) * inverse / -std::expm1(-2 * inverse);
}

/// Mitsuba's I₀(x) over the exact one: it has eleven terms of the power series and, for large x,
/// half of the asymptotic series' second term. Values follow Mitsuba, densities are exact.
float bessel_bias(float x) {
  if (x < 4) return 1;
  const float exact = scaled_bessel_i0(x);
  if (x > 12) return std::exp(1 / (16 * x)) / (std::sqrt(2 * kPi * x) * exact);
  float sum = 1, term = 1;
  for (int i = 1; i <= 10; ++i) sum += term *= sqr(x / (2 * float(i)));
  return sum * std::exp(-x) / exact;
}

float logistic(float x, float scale) {
  const float e = std::exp(-std::abs(x) / scale);
  return e / (scale * sqr(1 + e));
}

/// Textures may say indices that no matter has.
constexpr float kLeastEta = 1e-3f;

/// To [−π, π].
float wrapped(float angle) {
  return angle - 2 * kPi * std::round(angle * (0.5f * kInvPi));
}

}  // namespace

struct HairModel::View {
  float sin_theta, cos_theta;  ///< latitude above the fibre's cross-section
  float phi;                   ///< longitude
  Spectrum attenuation[kLobes + 1];
  float probability[kLobes + 1];
  float sin_tilted[kLobes], cos_tilted[kLobes];  ///< latitude as the tilted scales see it
  float deflection[kLobes];  ///< change of longitude by perfect refraction and reflection
};

HairModel::HairModel(float longitudinal_roughness, float azimuthal_roughness, float tilt, float eta,
                     const Spectrum& absorption)
    : eta_(eta), absorption_(absorption) {
  const float l = longitudinal_roughness, a = azimuthal_roughness;
  // Rougher than a mirror by what single precision resolves.
  const float v = std::max(sqr(0.726f * l + 0.812f * l * l + 3.7f * std::pow(l, 20.0f)), 2e-5f);
  variance_[0] = v;
  variance_[1] = std::max(0.25f * v, 2e-5f);
  variance_[2] = variance_[3] = 4 * v;
  logistic_scale_ = std::max(
      std::sqrt(kPi / 8) * (0.265f * a + 1.194f * a * a + 5.372f * std::pow(a, 22.0f)), 1e-3f);
  logistic_norm_ = std::tanh(kPi / (2 * logistic_scale_));
  constexpr float kTurns[kLobes] = {-2, 1, 4};
  for (int p = 0; p < kLobes; ++p) {
    sin_turn_[p] = std::sin(kTurns[p] * tilt);
    cos_turn_[p] = std::cos(kTurns[p] * tilt);
  }
}

HairModel::View HairModel::view(const Vector3f& w) const {
  View o;
  o.sin_theta = w.y;
  o.cos_theta = safe_sqrt(1 - w.y * w.y);
  o.phi = std::atan2(w.z, w.x);
  // Where the view meets the cross-section: the sine of the angle to the normal there.
  const float across = std::sqrt(w.x * w.x + w.z * w.z);
  const float h = across > 0 ? std::clamp(-w.x / across, -1.0f, 1.0f) : 0.0f;
  const float gamma_o = across > 0 ? std::atan2(-w.x, w.z) : 0.0f;
  const float cos_gamma_o = safe_sqrt(1 - h * h);
  // Refraction into the fibre, along it and across.
  const float cos_theta_t = safe_sqrt(1 - sqr(o.sin_theta / eta_));
  const float eta_across = safe_sqrt(eta_ * eta_ - sqr(o.sin_theta)) / std::max(o.cos_theta, 1e-6f);
  const float sin_gamma_t =
      eta_across > 0 ? std::clamp(h / eta_across, -1.0f, 1.0f) : std::copysign(1.0f, h);
  const float cos_gamma_t = safe_sqrt(1 - sin_gamma_t * sin_gamma_t);
  const float gamma_t = std::asin(sin_gamma_t);
  const float path = 2 * cos_gamma_t / std::max(cos_theta_t, 1e-6f);
  const Spectrum t(std::exp(-absorption_.r * path), std::exp(-absorption_.g * path),
                   std::exp(-absorption_.b * path));
  const float f = fresnel_dielectric(o.cos_theta * cos_gamma_o, eta_).reflectance;
  o.attenuation[0] = Spectrum(f);
  o.attenuation[1] = t * sqr(1 - f);
  o.attenuation[2] = o.attenuation[1] * t * f;
  // A geometric series.
  const auto rest = [&](float last, float tc) {
    const float q = tc * f;
    return q < 1 ? last * q / (1 - q) : 0.0f;
  };
  const Spectrum& last = o.attenuation[2];
  o.attenuation[3] = {rest(last.r, t.r), rest(last.g, t.g), rest(last.b, t.b)};
  float sum = 0;
  for (int p = 0; p <= kLobes; ++p) sum += o.probability[p] = o.attenuation[p].luminance();
  for (float& p : o.probability) p = sum > 0 ? p / sum : 0.0f;
  for (int p = 0; p < kLobes; ++p) {
    o.sin_tilted[p] = o.sin_theta * cos_turn_[p] + o.cos_theta * sin_turn_[p];
    o.cos_tilted[p] = std::abs(o.cos_theta * cos_turn_[p] - o.sin_theta * sin_turn_[p]);
    o.deflection[p] = 2 * float(p) * gamma_t - 2 * gamma_o + float(p) * kPi;
  }
  return o;
}

ModelEval HairModel::eval_from(const View& o, const Vector3f& w) const {
  const float sin_theta = w.y, cos_theta = safe_sqrt(1 - w.y * w.y);
  const float turn = std::atan2(w.z, w.x) - o.phi;
  ModelEval e;
  for (int p = 0; p < kLobes; ++p) {
    const float m =
        longitudinal(o.sin_tilted[p], o.cos_tilted[p], sin_theta, cos_theta, variance_[p]);
    const float n = logistic(wrapped(turn - o.deflection[p]), logistic_scale_) / logistic_norm_;
    e.value += o.attenuation[p] * (m * n * bessel_bias(o.cos_tilted[p] * cos_theta / variance_[p]));
    e.pdf += o.probability[p] * (m * n);
  }
  const float m = longitudinal(o.sin_theta, o.cos_theta, sin_theta, cos_theta, variance_[kLobes]) *
                  (0.5f * kInvPi);
  e.value += o.attenuation[kLobes] * (m * bessel_bias(o.cos_theta * cos_theta / variance_[kLobes]));
  e.pdf += o.probability[kLobes] * m;
  return e;
}

ModelEval HairModel::eval_both(const View& o, const Vector3f& wo, const Vector3f& wi,
                               Transport transport) const {
  ModelEval e = eval_from(o, wi);
  if (transport == Transport::radiance) return e;
  e.value = wo.z == 0 ? Spectrum(0) : eval_from(view(wi), wo).value * std::abs(wi.z / wo.z);
  return e;
}

ModelEval HairModel::eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const {
  return eval_both(view(wo), wo, wi, transport);
}

std::optional<ModelSample> HairModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                             Transport transport) const {
  const View o = view(wo);
  int p = 0;
  while (p < kLobes && u >= o.probability[p]) u -= o.probability[p++];
  if (!(o.probability[p] > 0)) return std::nullopt;
  u = std::min(u / o.probability[p], kBelowOne);
  // The angle to the mirrored cone. Source: d'Eon et al., "Importance Sampling for Physically-Based
  // Hair Fiber Models", 2013.
  const float variance = variance_[p];
  const float away = 1 + variance * std::log(v.x + (1 - v.x) * std::exp(-2 / variance));
  const float sideways = safe_sqrt(1 - away * away) * std::cos(2 * kPi * v.y);
  const float sin_o = p < kLobes ? o.sin_tilted[p] : o.sin_theta;
  const float cos_o = p < kLobes ? o.cos_tilted[p] : o.cos_theta;
  const float sin_theta = std::clamp(-away * sin_o + sideways * cos_o, -1.0f, 1.0f);
  const float cos_theta = safe_sqrt(1 - sin_theta * sin_theta);
  float turn;
  if (p < kLobes) {
    // The logistic distribution, cut off at ±π.
    const float low = 0.5f * (1 - logistic_norm_);
    const float x = u * logistic_norm_ + low;
    turn = o.deflection[p] + std::clamp(-logistic_scale_ * std::log(1 / x - 1), -kPi, kPi);
  } else {
    turn = 2 * kPi * u;
  }
  const float phi = o.phi + turn;
  const Vector3f wi =
      normalize(Vector3f(cos_theta * std::cos(phi), sin_theta, cos_theta * std::sin(phi)));
  return sample_from(eval_both(o, wo, wi, transport), wi);
}

Spectrum hair_absorption_for(const Spectrum& color, float azimuthal_roughness) {
  const float a = azimuthal_roughness;
  const float d = 5.969f + a * (-0.215f + a * (2.532f + a * (-10.73f + a * (5.574f + a * 0.245f))));
  const auto of = [&](float c) { return sqr(std::log(std::clamp(c, 1e-4f, 1.0f)) / d); };
  return {of(color.r), of(color.g), of(color.b)};
}

HairFibre::HairFibre(const HairOptions& options) : options_(options) {
  if (textures().empty()) set_constant(model({}));
}

std::vector<const Texture*> HairFibre::textures() const {
  const HairOptions& o = options_;
  std::vector<const Texture*> all;
  for (const FloatSlot* slot :
       {&o.longitudinal_roughness, &o.azimuthal_roughness, &o.scale_tilt, &o.eta})
    slot->list_texture(all);
  if (o.reflectance) {
    o.reflectance->list_texture(all);
  } else if (o.absorption) {
    o.absorption->list_texture(all);
  } else {
    o.eumelanin.list_texture(all);
    o.pheomelanin.list_texture(all);
  }
  return all;
}

Spectrum HairFibre::absorption(const Surface& s, float azimuthal_roughness) const {
  const HairOptions& o = options_;
  if (o.reflectance) return hair_absorption_for((*o.reflectance)(s), azimuthal_roughness);
  if (o.absorption) {
    const Spectrum sigma = (*o.absorption)(s)*o.absorption_scale;
    return {std::max(sigma.r, 0.0f), std::max(sigma.g, 0.0f), std::max(sigma.b, 0.0f)};
  }
  return hair_absorption(std::max(o.eumelanin(s), 0.0f), std::max(o.pheomelanin(s), 0.0f));
}

HairModel HairFibre::model(const Surface& s) const {
  const HairOptions& o = options_;
  const auto roughness = [&](const FloatSlot& slot) { return std::clamp(slot(s), 0.0f, 1.0f); };
  const float azimuthal = roughness(o.azimuthal_roughness);
  return {roughness(o.longitudinal_roughness), azimuthal, o.scale_tilt(s) * float(kRadians),
          std::max(o.eta(s), kLeastEta), absorption(s, azimuthal)};
}

SurfaceNeeds HairFibre::needs() const {
  bool uv = false;
  for (const Texture* texture : textures()) uv = uv || texture->needs_uv();
  return {.uv = uv, .tangents = true};
}

}  // namespace duet
