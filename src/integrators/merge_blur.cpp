#include "integrators/merge_blur.h"

#include <algorithm>

#include "transport/counters.h"

namespace duet {

float merge_blur(const Scene& scene, const PathVertex& eye, const Point3f& photon,
                 const PhotonArrival& arrival, const PhotonShift& shift, RenderCounters& counters) {
  const Point3f& x = eye.position();
  if (shift.edge < shift.scale) {
    ++counters.shadow_rays;
    if (scene.accel->occluded(spawn_ray_to(eye.surface, arrival.from))) return 1;
  }
  // What the photon brings per area at its place, and would bring at the vertex.
  const Vector3f beside = arrival.from - (x + (photon - x) * shift.scale);
  const Vector3f at = arrival.from - x;
  const float d2_beside = length_squared(beside), d2_at = length_squared(at);
  if (!(d2_beside > 0 && d2_at > 0)) return 0;
  const Vector3f w_beside = beside * (1 / std::sqrt(d2_beside)), w_at = at * (1 / std::sqrt(d2_at));
  const float cosine = eye.cosine(w_beside);
  if (!(cosine > 0)) return 0;
  const float merged = eye.eval(w_beside, Transport::radiance).value.mean() *
                       std::abs(dot(arrival.normal, w_beside)) / (cosine * d2_beside);
  if (!(merged > 0)) return 0;
  const float meant = eye.eval(w_at, Transport::radiance).value.mean() / d2_at;
  return 1 - std::min(2.0f, meant / merged);
}

}  // namespace duet
