#include "scene/light_media.h"

#include <map>

#include "math/warp.h"

namespace duet {

namespace {

/// Rays in this number of directions decide what surrounds a point.
constexpr int kDirections = 32;
/// No ray meets more surfaces.
constexpr int kMostSurfaces = 4096;

/// Directions all around, none of them along an axis. Source: Swinbank & Purser, "Fibonacci grids",
/// 2006.
Vector3f direction(int i) {
  constexpr float kGoldenRatio = 1.6180339887f;
  const float z = 1 - (2 * float(i) + 1) / kDirections, r = std::sqrt(1 - z * z);
  const float phi = 2 * kPi * (float(i) + 0.3f) * kGoldenRatio;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Visits the surfaces along a ray that separate media, until `visit(surface)` returns false.
template <class Visit>
void boundaries(const Scene& scene, Ray ray, Visit visit) {
  for (int i = 0; i < kMostSurfaces; ++i) {
    Hit hit;
    if (!scene.accel->closest_hit(ray, hit)) return;
    const Surface s = scene.surface(ray, hit);
    if (s.shape->separates_media() && !visit(s)) return;
    ray = spawn_ray(s, ray.direction);
  }
}

}  // namespace

const Medium* outermost_medium(const Scene& scene) {
  const Point3f origin = scene.camera->sample_ray({0.5f, 0.5f}, {0.5f, 0.5f}).origin;
  std::map<const Medium*, int> votes;
  for (int i = 0; i < kDirections; ++i) {
    const Medium* medium = scene.camera_medium;
    const Vector3f w = direction(i);
    boundaries(scene, {origin, w, INFINITY}, [&](const Surface& s) {
      medium = scene.medium_beyond(s, w);
      return true;
    });
    ++votes[medium];
  }
  // Surfaces that are not closed may lead some of the rays astray.
  const Medium* most = nullptr;
  for (const auto& m : scene.media)
    if (votes[m.get()] > votes[most]) most = m.get();
  return most;
}

const Medium* medium_at(const Scene& scene, const Point3f& p, const Medium* outermost) {
  const Medium* medium = outermost;
  float nearest = INFINITY;
  for (int i = 0; i < kDirections; ++i) {
    const Vector3f w = direction(i);
    boundaries(scene, {p, w, INFINITY}, [&](const Surface& s) {
      if (const float d = distance(s.position, p); d < nearest) {
        nearest = d;
        medium = scene.medium_beyond(s, -w);
      }
      return false;
    });
  }
  return medium;
}

const Medium* medium_before(const Scene& scene, const Light& light, const Medium* outermost) {
  if (is_infinite(light.kind())) return outermost;
  const auto ray = light.sample_emission({0.37f, 0.53f}, {0.61f, 0.29f});
  if (!ray) return outermost;
  for (const Shape& shape : scene.shapes)
    if (scene.light_on(shape) == &light && shape.separates_media())
      return shape.exterior == kNone ? nullptr : scene.media[shape.exterior].get();
  return medium_at(scene, ray->ray.origin, outermost);
}

}  // namespace duet
