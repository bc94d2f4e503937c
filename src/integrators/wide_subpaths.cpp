#include "integrators/wide_subpaths.h"

#include "base/instruction_sets.h"
#include "integrators/wide_kernels.h"
#include "materials/plain_diffuse.h"

namespace duet {

DUET_WIDEST void arrive(int n, const HitBatch& hits, const WidePoints& points, bool connections,
                        WidePaths& paths, WideSubpaths& subpaths) {
  const float connects = connections ? 1.0f : 0.0f;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const float cosine = std::abs(dot(points.ng.vector(i), paths.ray.direction.vector(i)));
    const float inverse = cosine > 0 ? 1 / cosine : 0.0f, goes_on = cosine > 0 ? 1.0f : 0.0f;
    subpaths.vcm[i] = connects * subpaths.vcm[i] * (hits.t[i] * hits.t[i]) * inverse;
    subpaths.vc[i] = subpaths.vc[i] * inverse;
    subpaths.vm[i] = subpaths.vm[i] * inverse;
    paths.throughput.set(i, paths.throughput.x[i] * goes_on, paths.throughput.y[i] * goes_on,
                         paths.throughput.z[i] * goes_on);
  }
}

DUET_WIDEST void make_ends(int n, const WidePaths& paths, const WideSubpaths& subpaths,
                           const WidePoints& points, WideEnds& out) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Vector3f ns = points.ns.vector(i);
    const float cosine = -dot(ns, paths.ray.direction.vector(i));
    const float side = PlainDiffuse::lit_side(cosine, points.two_sided[i] != 0);
    out.lit.set(i, ns * side);
    out.reverse[i] = std::abs(cosine) * kInvPi;
    out.merges[i] = 1;
    const float vc = subpaths.vc[i], vm = subpaths.vm[i];
    out.sum[i] = out.unmerged[i] != 0 ? vm : vc;
    out.flux.set(i, paths.throughput.x[i] * points.reflectance.x[i],
                 paths.throughput.y[i] * points.reflectance.y[i],
                 paths.throughput.z[i] * points.reflectance.z[i]);
  }
}

namespace {

template <bool kRoulette>
[[gnu::always_inline]] inline void continue_subpaths(int n, const WideDepartures& from,
                                                     WideScattering& scattering, WidePaths& paths,
                                                     WideSubpaths& subpaths) {
  const Roulette roulette = kRoulette ? *from.roulette : Roulette{};
  const WideEnds& ends = from.ends;
  const WidePoints& points = from.points;
  const TechniqueSet& set = from.set;
  const float merge_term = set.merge_term(), connection_term = set.subpath_connection_term(),
              merges = set.merges ? set.subpath_merges() : 0.0f;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const float x = scattering.weight.x[i], y = scattering.weight.y[i], z = scattering.weight.z[i];
    const float r = paths.throughput.x[i] * x, g = paths.throughput.y[i] * y,
                b = paths.throughput.z[i] * z;
    const float eta = scattering.eta[i];
    float carried = subpaths.carried[i] * std::max(std::max(x, y), z) * (eta * eta);
    int32_t alive = scattering.alive[i];
    alive = std::max(std::max(r, g), b) > 0 ? alive : 0;
    float scale = 1;
    if constexpr (kRoulette) {
      const float survival = roulette.probability(carried);
      alive = scattering.roulette[i] < survival ? alive : 0;
      scale = 1 / survival;
    }
    scattering.alive[i] = alive;
    paths.throughput.set(i, r * scale, g * scale, b * scale);
    subpaths.carried[i] = carried * scale;
    const Vector3f ng = points.ng.vector(i), wi = scattering.wi.vector(i);
    const float pdf = scattering.pdf[i], out = dot(ng, wi);
    const bool delta = pdf < 0;
    const float reverse = ends.reverse[i], inverse = 1 / pdf,
                to_next = std::abs(out) * (delta ? reverse : inverse);
    const bool merged = ends.merges[i] != 0;
    const float vcm = subpaths.vcm[i], vc = subpaths.vc[i], vm = subpaths.vm[i];
    const float vc_sum = (merged ? merge_term : 0.0f) + vcm + reverse * vc,
                vm_sum = (merged ? merges : 0.0f) + vcm * connection_term + reverse * vm;
    subpaths.vcm[i] = delta ? 0.0f : inverse;
    subpaths.vc[i] = to_next * (delta ? vc : vc_sum);
    subpaths.vm[i] = to_next * (delta ? vm : vm_sum);
    paths.bsdf_pdf[i] = pdf;
    const Point3f position = points.position.point(i);
    paths.from.set(i, position);
    paths.ray.origin.set(i, moved_off(position, ng, points.offset[i], out));
    paths.ray.direction.set(i, wi);
    paths.ray.tmax[i] = INFINITY;
  }
}

}  // namespace

DUET_WIDEST void go_on(int n, const WideDepartures& from, WideScattering& scattering,
                       WidePaths& paths, WideSubpaths& subpaths) {
  if (from.roulette)
    continue_subpaths<true>(n, from, scattering, paths, subpaths);
  else
    continue_subpaths<false>(n, from, scattering, paths, subpaths);
}

}  // namespace duet
