#include "media/cloud.h"

#include <algorithm>

#include "textures/noise.h"

namespace duet {

namespace {

/// Difference quotients of the noise, by which a lookup is displaced.
Vector3f noise_gradient(const Point3f& p) {
  constexpr float kStep = 0.01f;
  const float here = perlin_noise(p);
  return Vector3f(perlin_noise(p + Vector3f(kStep, 0, 0)) - here,
                  perlin_noise(p + Vector3f(0, kStep, 0)) - here,
                  perlin_noise(p + Vector3f(0, 0, kStep)) - here) *
         (1 / kStep);
}

Point3f scaled(const Point3f& p, float s) {
  return {p.x * s, p.y * s, p.z * s};
}

}  // namespace

CloudVolume::CloudVolume(const CloudShape& shape, const Spectrum& extinction,
                         const Matrix4& to_world)
    : shape_(shape), extinction_(extinction), to_world_(to_world) {}

int CloudVolume::channels() const {
  return extinction_.r == extinction_.g && extinction_.g == extinction_.b ? 1 : 3;
}

float CloudVolume::density(const Point3f& p) const {
  for (int i = 0; i < 3; ++i)
    if (!(p[i] >= shape_.lower[i] && p[i] <= shape_.upper[i])) return 0;
  Point3f at = scaled(p, shape_.frequency);
  if (shape_.wispiness > 0) {
    float amplitude = 0.05f * shape_.wispiness, frequency = 10;
    for (int octave = 0; octave < 2; ++octave) {
      at = at + noise_gradient(scaled(at, frequency)) * amplitude;
      amplitude *= 0.5f;
      frequency *= 1.99f;
    }
  }
  constexpr int kOctaves = 5;
  const float noise = 0.5f * fractal_noise(at, 0.5f, kOctaves);
  // Rounded heaps above, a closed layer below.
  const float heaps = std::clamp((1 - p.y) * 4.5f * shape_.density * noise, 0.0f, 1.0f);
  return std::clamp(heaps + 2 * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

void CloudVolume::world_box(Point3f& lower, Point3f& upper) const {
  map_box(to_world_, shape_.lower, shape_.upper, lower, upper);
}

float CloudVolume::maximum(const Point3f& lower, const Point3f& upper) const {
  for (int i = 0; i < 3; ++i)
    if (!(upper[i] >= shape_.lower[i] && lower[i] <= shape_.upper[i])) return 0;
  return extinction_.max();
}

}  // namespace duet
