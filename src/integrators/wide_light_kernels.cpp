#include "integrators/wide_light_kernels.h"

#include "base/instruction_sets.h"
#include "integrators/wide_kernels.h"
#include "transport/connection.h"

namespace duet {

DUET_WIDEST void weigh_camera(int n, const WideCameraConnections& c,
                              const WideLightSamples& samples, WideSeen& seen,
                              WideShadowRays& out) {
  const WideCameraConnections all = c;
  const float weighs = all.unit_weights ? 0.0f : 1.0f;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Normal3f ng = all.points.ng.normal(i);
    const Vector3f to_lens = samples.wi.vector(i);
    const float adjoint =
        adjoint_factor(all.points.ns.normal(i), ng, -all.paths.ray.direction.vector(i), to_lens);
    const float importance = seen.importance[i];
    const float merge_term = all.ends.merges[i] != 0 ? all.ends.merge_term[i] : 0.0f;
    const float arrival = importance * std::abs(dot(ng, to_lens));
    const float gain =
        LightSampleVariance::gain(seen.other_lights[i], seen.light_distance[i], 1 / arrival);
    const float others =
        all.scale * beyond(arrival, merge_term, gain * all.subpaths.vcm[i], all.ends.reverse[i],
                           gain * all.ends.sum[i] * seen.eye_paths[i]);
    const float weight = 1 / (1 + (weighs != 0 ? others : 0.0f));
    const float scale = adjoint * importance;
    const float r = all.paths.throughput.x[i] * samples.value.x[i] * scale,
                g = all.paths.throughput.y[i] * samples.value.y[i] * scale,
                b = all.paths.throughput.z[i] * samples.value.z[i] * scale;
    const float most = std::max(std::max(r, g), b);
    const float kept =
        ConnectionRoulette::keep(most * weight, all.threshold,
                                 ConnectionRoulette::draw(all.ends.roulette[i], all.connection));
    out.contribution.set(i, r * kept, g * kept, b * kept);
    seen.weight[i] = weight;
    // What is not a number is to be seen, and counted.
    const int32_t dropped = kept > 0 ? 0 : 1, nothing = most <= 0 ? 1 : dropped;
    out.blocked[i] = samples.pdf[i] < 0 ? 1 : nothing;
    out.id[i] = i;
    set_shadow_ray(i, all.points, samples, out.ray);
  }
}

DUET_WIDEST void weigh_by_adjoint(int n, const WidePaths& paths, const WidePoints& points,
                                  WideScattering& scattering) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const float adjoint = adjoint_factor(points.ns.normal(i), points.ng.normal(i),
                                         -paths.ray.direction.vector(i), scattering.wi.vector(i));
    scattering.weight.set(i, scattering.weight.x[i] * adjoint, scattering.weight.y[i] * adjoint,
                          scattering.weight.z[i] * adjoint);
  }
}

}  // namespace duet
