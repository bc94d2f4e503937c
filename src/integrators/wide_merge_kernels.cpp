#include "integrators/wide_merge_kernels.h"

#include "base/instruction_sets.h"

namespace duet {

namespace {

/// `scattered(k, i, wi)` is what point i makes of the direction of photon k.
template <class F>
[[gnu::always_inline]] inline void merge_all(int n, const WidePhotons& photons, const WideMerges& m,
                                             const F& scattered, BatchTriples& out,
                                             BatchArray<int32_t>& merged) {
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
    const Scattered f = scattered(k, i, wi);
    const float weight = 1 / (1 + photons.vcm[k] * term + f.pdf * (light_sums[k] * unit) +
                              all.subpaths.vcm[i] * term + f.reverse * (eye_sums[i] * unit));
    const float within = photons.depth[k] <= all.most ? 1.0f : 0.0f;
    const float scale = all.kernel[i] * within;
    const float r = f.r * photons.arriving.x[k] * scale, g = f.g * photons.arriving.y[k] * scale,
                b = f.b * photons.arriving.z[k] * scale;
    // What is not a number is to be seen, and counted.
    merged[k] = std::max(std::max(r, g), b) == 0 ? 0 : 1;
    out.set(k, r * weight, g * weight, b * weight);
  }
}

}  // namespace

DUET_WIDEST void merge_photons(int n, const WidePhotons& photons, const WideMerges& m,
                               BatchTriples& out, BatchArray<int32_t>& merged) {
  const WideEnds& ends = m.ends;
  merge_all(
      n, photons, m,
      [&](int, int i, const Vector3f& wi)
          __attribute__((always_inline)) { return scattered_diffusely(ends, i, wi); },
      out, merged);
}

DUET_WIDEST void merge_glossy_photons(int n, const WidePhotons& photons, const EndBsdfs& bsdfs,
                                      const WideMerges& m, BatchTriples& out,
                                      BatchArray<int32_t>& merged) {
  const BatchTriples& throughput = m.paths.throughput;
  merge_all(
      n, photons, m,
      [&](int k, int i, const Vector3f&)
          __attribute__((always_inline)) { return scattered(bsdfs, k, throughput, i); },
      out, merged);
}

}  // namespace duet
