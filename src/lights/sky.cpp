#include "lights/sky.h"

#include <cmath>
#include <numbers>

#include "lights/sky_tables.h"
#include "math/angles.h"
#include "math/trig.h"
#include "math/warp.h"

namespace duet {

namespace {

/// The models' units to those of radiance.
constexpr float kUnit = float(1 / 106.7502593994140625);

/// Where a value lies in a table of `count` entries: the entry below it, and how far beyond.
struct Between {
  int below;
  float beyond;
  Between(double x, int count) {
    x = std::clamp(x, 0.0, double(count - 1));
    below = std::min(int(x), count - 2);
    beyond = float(x - below);
  }
};

/// Interpolates a table over turbidity, ground albedo and elevation of the sun, for a channel.
template <class Table>
float interpolate(const Table& table, int width, int column, const Between& turbidity, float albedo,
                  float elevation) {
  constexpr float binomial[kSkyControlPoints] = {1, 5, 10, 10, 5, 1};
  const float x = std::min(float(std::cbrt(2 / std::numbers::pi * double(elevation))), 1.0f);
  float sum = 0;
  for (int t = 0; t < 2; ++t)
    for (int a = 0; a < 2; ++a) {
      const float share = (t ? turbidity.beyond : 1 - turbidity.beyond) * (a ? albedo : 1 - albedo);
      const int first = ((turbidity.below + t) * 2 + a) * kSkyControlPoints;
      for (int i = 0; i < kSkyControlPoints; ++i) {
        const float weight = binomial[i] * std::pow(x, float(i)) * std::pow(1 - x, float(5 - i));
        sum += share * weight * table[size_t((first + i) * width + column)];
      }
    }
  return sum;
}

Spectrum sun_irradiance(double turbidity, double elevation) {
  const Between t(turbidity - 1, kSkyTurbidities);
  const Between e((elevation * kDegrees - 2) / 3, kSunElevations);
  Spectrum sum(0.0f);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const float share = (i ? t.beyond : 1 - t.beyond) * (j ? e.beyond : 1 - e.beyond);
      const float* rgb =
          &kSunIrradiance[size_t(((t.below + i) * kSunElevations + e.below + j) * 3)];
      sum += Spectrum(rgb[0], rgb[1], rgb[2]) * share;
    }
  return sum;
}

Spectrum exp(const Spectrum& s) {
  return {std::exp(s.r), std::exp(s.g), std::exp(s.b)};
}

}  // namespace

Sky::Sky(const SkyOptions& o, const Matrix4& to_world)
    : axes_(rotation(to_world)),
      sun_(normalize(o.sun)),
      disk_(o.disk ? normalize(o.disk->direction) : sun_),
      disk_frame_(Normal3f(disk_)),
      stretch_(float(o.stretch)),
      extend_(o.extend),
      shines_(sun_.z >= 0),
      horizon_cuts_sun_(!o.disk) {
  const float elevation = std::asin(std::clamp(sun_.z, 0.0f, 1.0f));
  const Between turbidity(o.turbidity - 1, kSkyTurbidities);
  for (int c = 0; c < 3; ++c) {
    const auto channel = [c](Spectrum& s) -> float& { return c == 0 ? s.r : c == 1 ? s.g : s.b; };
    Spectrum albedo = o.albedo;
    for (int i = 0; i < kSkyParameters; ++i)
      channel(shape_[size_t(i)]) =
          interpolate(kSkyShape, 27, c * 9 + i, turbidity, channel(albedo), elevation);
    channel(zenith_) = interpolate(kSkyRadiance, 3, c, turbidity, channel(albedo), elevation) *
                       kUnit * float(o.sky_scale);
  }
  const double half = o.sun_aperture * std::numbers::pi / 360;
  // In this form what is small keeps its digits: 1 − cos x = 2 sin²(x / 2).
  const double span = 2 * std::pow(std::sin(half / 2), 2);
  one_minus_cos_sun_ = float(span);
  sun_chord2_ = float(2 * span);
  sun_density_ = float(1 / (2 * std::numbers::pi * span));
  const Spectrum irradiance =
      o.disk ? o.disk->irradiance : sun_irradiance(o.turbidity, double(elevation));
  sun_radiance_ = irradiance * (sun_density_ * float(o.sun_scale));
  if (extend_)
    lowest_ = -1;
  else
    lowest_ = float(std::cos(std::min(std::numbers::pi, 0.5 * std::numbers::pi * o.stretch)));
  if (std::abs(lowest_) < 1e-6f) lowest_ = 0;
  tabulate();
}

Spectrum Sky::sky(const Vector3f& w) const {
  float cos_theta = w.z, fade = 1;
  Vector3f place = w;
  if (stretch_ != 1 || extend_) {
    const float theta = 2 * kPi * atan2_turns(std::sqrt(w.x * w.x + w.y * w.y), w.z);
    if (extend_) {
      const float x = std::clamp(2 - 2 * theta / kPi, 0.0f, 1.0f);
      fade = x * x * (3 - 2 * x);
    }
    const float drawn = std::min(theta / stretch_, 0.5f * kPi - 1e-4f);
    cos_theta = std::cos(drawn);
    const float r = std::sqrt(std::max(w.x * w.x + w.y * w.y, 1e-30f));
    const float s = std::sin(drawn) / r;
    place = {w.x * s, w.y * s, cos_theta};
  }
  // The angle to the sun, from the chord between the two directions.
  const float gamma = 2 * std::asin(std::min(0.5f * length(place - sun_), 1.0f));
  const float cos_gamma = std::cos(gamma), cos2_gamma = cos_gamma * cos_gamma;
  const auto& p = shape_;
  const Spectrum one(1.0f);
  const Spectrum horizon = one + p[0] * exp(p[1] * (1 / (std::max(cos_theta, 0.0f) + 0.01f)));
  const Spectrum base = one + p[8] * p[8] - p[8] * (2 * cos_gamma);
  const auto glow = [&](float b) { return (1 + cos2_gamma) / (b * std::sqrt(b)); };
  const Spectrum chi(glow(base.r), glow(base.g), glow(base.b));
  const Spectrum around = p[2] + p[3] * exp(p[4] * gamma) + p[5] * cos2_gamma + p[6] * chi +
                          p[7] * safe_sqrt(cos_theta);
  const Spectrum fitted = horizon * around * zenith_ * fade;
  // With the sun at the horizon of very clear air the fit falls below zero.
  return {std::max(fitted.r, 0.0f), std::max(fitted.g, 0.0f), std::max(fitted.b, 0.0f)};
}

Spectrum Sky::radiance(const Vector3f& w, bool in_sun) const {
  if (!shines_) return Spectrum(0.0f);
  const Spectrum s = w.z >= lowest_ ? sky(w) : Spectrum(0.0f);
  return in_sun && (w.z >= 0 || !horizon_cuts_sun_) ? s + sun_radiance_ : s;
}

void Sky::tabulate() {
  const float height = (1 - lowest_) / float(kRows);
  std::vector<float> weights(size_t(kRows * kColumns), 0.0f);
  double sum = 0;
  constexpr int kPoints = 3;
  if (shines_)
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        float& weight = weights[size_t(row * kColumns + column)];
        for (int i = 0; i < kPoints * kPoints; ++i) {
          const float z = lowest_ + height * (float(row) + (float(i / kPoints) + 0.5f) / kPoints);
          float s, c;
          sincos_turns((float(column) + (float(i % kPoints) + 0.5f) / kPoints) / kColumns, s, c);
          const float r = safe_sqrt(1 - z * z);
          weight += std::max(sky({r * c, r * s, z}).luminance(), 0.0f);
        }
        weight /= kPoints * kPoints;
        sum += double(weight);
      }
  // No field is left out, whatever the points in it say.
  for (float& w : weights) w += float(0.02 * sum / (kRows * kColumns));
  cells_ = DiscreteDistribution(weights);
  const double solid_angle = 2 * std::numbers::pi * double(1 - lowest_);
  cell_density_ = float(kRows * kColumns / solid_angle);
  const double from_sky = sum / (kRows * kColumns) * solid_angle;
  const double from_sun =
      shines_ ? std::max(0.0, double(sun_radiance_.luminance()) / double(sun_density_)) : 0;
  mean_ = (from_sky + from_sun) / (4 * std::numbers::pi);
  sun_share_ = from_sun + from_sky > 0 ? float(from_sun / (from_sun + from_sky)) : 0;
}

float Sky::density(const Vector3f& w, bool in_sun) const {
  const float sun = in_sun ? sun_share_ * sun_density_ : 0.0f;
  if (!(w.z >= lowest_)) return sun;
  const float row = (w.z - lowest_) / (1 - lowest_) * kRows;
  const float turns = atan2_turns(w.y, w.x);
  const float column = (turns < 0 ? turns + 1 : turns) * kColumns;
  const int i = std::clamp(int(row), 0, kRows - 1), j = std::clamp(int(column), 0, kColumns - 1);
  return sun + (1 - sun_share_) * cells_.probability(uint32_t(i * kColumns + j)) * cell_density_;
}

Spectrum Sky::emitted(const Point3f&, const Vector3f& wi) const {
  const Vector3f w = axes_.to_local(wi);
  return radiance(w, in_sun(w));
}

PdfW Sky::pdf_direct(const Point3f&, const Vector3f& wi) const {
  const Vector3f w = axes_.to_local(wi);
  return {density(w, in_sun(w))};
}

std::optional<LightSample> Sky::sample_direct(const Point3f&, const Point2f& u) const {
  Vector3f w;
  bool hits_sun = u.x < sun_share_;
  if (hits_sun) {
    w = disk_frame_.to_world(
        square_to_cone({std::min(u.x / sun_share_, kBelowOne), u.y}, one_minus_cos_sun_));
  } else {
    const float v = std::min((u.x - sun_share_) / (1 - sun_share_), kBelowOne);
    const auto pick = cells_.sample(v, u);
    const float row = float(pick.index / kColumns) + pick.remapped;
    const float z = lowest_ + (1 - lowest_) * row / kRows;
    float s, c;
    sincos_turns((float(pick.index % kColumns) + u.y) / kColumns, s, c);
    const float r = safe_sqrt(1 - z * z);
    w = {r * c, r * s, z};
    hits_sun = in_sun(w);
  }
  const Spectrum arrives = radiance(w, hits_sun);
  const PdfW pdf{density(w, hits_sun)};
  if (!(pdf.value > 0) || arrives.is_black()) return std::nullopt;
  return from_afar(axes_.to_world(w), arrives, pdf);
}

double Sky::power(double scene_radius) const {
  return sphere_power(scene_radius, mean_);
}

}  // namespace duet
