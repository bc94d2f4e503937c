#include "integrators/merge_blur.h"

#include <algorithm>

#include "transport/counters.h"

namespace duet {

namespace {

/// Cosine between the normals of two surfaces below which they are not one.
constexpr float kOneSurface = 0.5f;

}  // namespace

bool lacks_photons(const Scene& scene, const PathVertex& eye, float radius, const Point2f& u,
                   RenderCounters& counters) {
  const Surface& s = eye.surface;
  const Vector3f up = Vector3f(s.ng) * (dot(s.ng, eye.wo) < 0 ? -1.0f : 1.0f);
  const Frame frame(s.ng);
  const float distance = radius * std::sqrt(u.x), angle = 2 * kPi * u.y;
  const float height = radius * std::sqrt(1 - u.x);
  const Point3f beside =
      eye.position() + frame.to_world({distance * std::cos(angle), distance * std::sin(angle), 0});
  const Point3f above = beside + up * height;
  counters.shadow_rays += 2;
  if (scene.accel->occluded(spawn_ray_to(s, above))) return true;
  return !scene.accel->occluded({above, up * (-2 * height), 1});
}

float merge_blur(const Scene& scene, const PathVertex& eye, const Point3f& photon,
                 const PhotonArrival& arrival, const PhotonShift& shift, RenderCounters& counters) {
  const Point3f& x = eye.position();
  if (shift.edge < shift.scale) {
    if (std::abs(dot(arrival.normal, eye.surface.ng)) < kOneSurface) return 1;
    ++counters.shadow_rays;
    if (scene.accel->occluded(spawn_ray_to(eye.surface, arrival.from))) return 1;
  }
  // What the photon brings at its place, and would bring at the vertex: it is counted across its
  // direction, so that its light falls with the squared distance alone.
  const Vector3f beside = arrival.from - (x + (photon - x) * shift.scale);
  const Vector3f at = arrival.from - x;
  const float d2_beside = length_squared(beside), d2_at = length_squared(at);
  if (!(d2_beside > 0 && d2_at > 0)) return 0;
  const Vector3f w_beside = beside * (1 / std::sqrt(d2_beside)), w_at = at * (1 / std::sqrt(d2_at));
  const float merged = eye.eval(w_beside, Transport::radiance).value.mean() / d2_beside;
  if (!(merged > 0)) return 0;
  const float meant = eye.eval(w_at, Transport::radiance).value.mean() / d2_at;
  return 1 - std::min(2.0f, meant / merged);
}

}  // namespace duet
