#include "textures/solid_textures.h"

#include "math/hash.h"
#include "textures/noise.h"

namespace duet {

namespace {

/// Points of which the average of noise is made, and the edge of the box in which they lie.
constexpr uint32_t kAveragePoints = 4096;
constexpr float kPeriod = 256;

/// How far the surface is followed for a gradient, in texture coordinates, as in pbrt.
constexpr float kStep = 0.0005f;

}  // namespace

Point2f gradient_in_space(const Texture& texture, const Surface& s) {
  const auto slope = [&](const Vector3f& tangent) {
    Surface before = s, behind = s;
    before.position = s.position - tangent * (0.5f * kStep);
    behind.position = s.position + tangent * (0.5f * kStep);
    return (texture.value(behind) - texture.value(before)) / kStep;
  };
  return {slope(s.dp_du), slope(s.dp_dv)};
}

NoiseTexture::NoiseTexture(const NoiseOptions& options, const SpaceMap& map)
    : options_(options), map_(map) {
  Spectrum sum;
  for (uint32_t i = 0; i < kAveragePoints; ++i) {
    const auto coordinate = [&](uint32_t axis) {
      return kPeriod * to_unit_float(mix32(3 * i + axis));
    };
    const Point3f p(coordinate(0), coordinate(1), coordinate(2));
    sum += options.kind == NoiseKind::marble ? marble_at(p) : Spectrum(noise_at(p));
  }
  average_ = sum / float(kAveragePoints);
}

float NoiseTexture::noise_at(const Point3f& p) const {
  switch (options_.kind) {
    case NoiseKind::wrinkled:
      return turbulence(p, options_.roughness, options_.octaves);
    case NoiseKind::windy: {
      const Point3f far(0.1f * p.x, 0.1f * p.y, 0.1f * p.z);
      return std::abs(fractal_noise(far, 0.5f, 3)) * fractal_noise(p, 0.5f, 6);
    }
    default:
      return fractal_noise(p, options_.roughness, options_.octaves);
  }
}

/// A curve through colours: pieces of a Bézier spline, as bright as in the book.
Spectrum NoiseTexture::marble_at(const Point3f& p) const {
  static constexpr Spectrum kPale(0.58f, 0.58f, 0.6f), kGrey(0.5f), kWarm(0.6f, 0.59f, 0.58f),
      kVein(0.2f, 0.2f, 0.33f);
  static constexpr Spectrum kColors[] = {kPale, kPale, kPale, kGrey, kWarm,
                                         kPale, kPale, kVein, kPale};
  constexpr int kPieces = int(std::size(kColors)) - 3;
  const Point3f q(p.x * options_.scale, p.y * options_.scale, p.z * options_.scale);
  const float y = q.y + options_.variation * fractal_noise(q, options_.roughness, options_.octaves);
  const float x = (0.5f + 0.5f * std::sin(y)) * float(kPieces);
  const int first = std::clamp(int(x), 0, kPieces - 1);
  const float t = x - float(first), u = 1 - t;
  const Spectrum* c = kColors + first;
  return 1.5f * (c[0] * (u * u * u) + c[1] * (3 * u * u * t) + c[2] * (3 * u * t * t) +
                 c[3] * (t * t * t));
}

Spectrum NoiseTexture::color(const Surface& s) const {
  const Point3f p = map_(s.position);
  return options_.kind == NoiseKind::marble ? marble_at(p) : Spectrum(noise_at(p));
}

float NoiseTexture::value(const Surface& s) const {
  const Point3f p = map_(s.position);
  return options_.kind == NoiseKind::marble ? marble_at(p).luminance() : noise_at(p);
}

const ColorSlot& SolidCheckerboard::slot(const Surface& s) const {
  const Point3f p = map_(s.position);
  const float sum = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
  return std::fmod(sum, 2.0f) == 0 ? first_ : second_;
}

float SolidCheckerboard::value(const Surface& s) const {
  const ColorSlot& c = slot(s);
  return c.texture ? c.texture->value(s) : c.constant.luminance();
}

}  // namespace duet
