#include "integrators/wide_merge_kernels.h"

#include "base/instruction_sets.h"

namespace duet {

DUET_WIDEST void merge_photons(int n, const WidePhotons& photons, const WideMerges& m,
                               BatchTriples& out, BatchArray<int32_t>& merged) {
  const WideMerges all = m;
  const float term = all.connection_term;
  // BalanceWeights::merges() of the sums.
  const BatchArray<float>&eye_sums = all.partly_merged ? all.subpaths.vc : all.subpaths.vm,
        &light_sums = all.partly_merged ? photons.vc : photons.vm;
  const float unit = all.partly_merged ? term : 1.0f;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = photons.point[k];
    const Vector3f wi = decode_direction(photons.u[k], photons.v[k]);
    // Photons are counted per area of the surface, not of the shading normal's.
    const float cosine = std::abs(dot(all.points.ng.vector(i), wi)),
                inverse = cosine > 0 ? 1 / cosine : 0.0f;
    const float pdf = std::max(0.0f, dot(all.ends.lit.vector(i), wi) * kInvPi);
    const float weight =
        1 / (1 + photons.vcm[k] * term + pdf * (light_sums[k] * unit) + all.subpaths.vcm[i] * term +
             all.ends.reverse[i] * (eye_sums[i] * unit));
    const float within = photons.depth[k] <= all.most ? 1.0f : 0.0f;
    const float scale = pdf * all.kernel[i] * inverse * within;
    const float r = all.ends.flux.x[i] * photons.throughput.x[k] * scale,
                g = all.ends.flux.y[i] * photons.throughput.y[k] * scale,
                b = all.ends.flux.z[i] * photons.throughput.z[k] * scale;
    // What is not a number is to be seen, and counted.
    merged[k] = std::max(std::max(r, g), b) == 0 ? 0 : 1;
    out.set(k, r * weight, g * weight, b * weight);
  }
}

}  // namespace duet
