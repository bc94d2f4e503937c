#include "integrators/wide_kernels.h"

#include "base/instruction_sets.h"
#include "integrators/next_event.h"
#include "materials/plain_diffuse.h"
#include "math/frame.h"
#include "math/warp.h"

namespace duet {

DUET_WIDEST void make_points(int n, const WideTriangles& triangles, const WideBarycentrics& at,
                             WidePoints& points) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Point3f p0 = triangles.p0.point(i), p1 = triangles.p1.point(i),
                  p2 = triangles.p2.point(i);
    const Vector3f e1 = p1 - p0, e2 = p2 - p0;
    points.position.set(i, p0 + (e1 * at.b1[i] + e2 * at.b2[i]));
    points.offset[i] = kOffsetScale * std::max(std::max(max_abs(p0), max_abs(p1)), max_abs(p2));
    const Vector3f normal = cross(e1, e2);
    const Vector3f ng = normal * (triangles.sign[i] / std::sqrt(length_squared(normal)));
    points.ng.set(i, ng);
    points.ns.set(i, ng);
  }
}

DUET_WIDEST void make_smooth_points(int n, const WideTriangles& triangles,
                                    const WideBarycentrics& at, WidePoints& points) {
  make_points(n, triangles, at, points);
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const float b1 = at.b1[i], b2 = at.b2[i], b0 = 1 - b1 - b2;
    const Vector3f smooth =
        triangles.n0.vector(i) * b0 + triangles.n1.vector(i) * b1 + triangles.n2.vector(i) * b2;
    const float l2 = length_squared(smooth);
    const Vector3f unit = smooth * (triangles.sign[i] / std::sqrt(l2));
    const Vector3f ng = points.ng.vector(i);
    const float x = l2 > 0 ? unit.x : ng.x, y = l2 > 0 ? unit.y : ng.y, z = l2 > 0 ? unit.z : ng.z;
    const bool turned = dot(ng, Vector3f(x, y, z)) < 0;
    points.ns.set(i, x, y, z);
    points.ng.set(i, turned ? -ng.x : ng.x, turned ? -ng.y : ng.y, turned ? -ng.z : ng.z);
  }
}

DUET_WIDEST void evaluate_diffuse(int n, const WidePaths& paths, const WidePoints& points,
                                  WideLightSamples& samples) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Vector3f ns = points.ns.vector(i);
    const float side =
        PlainDiffuse::lit_side(-dot(ns, paths.ray.direction.vector(i)), points.two_sided[i] != 0);
    const float cosine = dot(ns, samples.wi.vector(i)) * side;
    const float pdf = cosine > 0 ? cosine * kInvPi : 0.0f;
    samples.value.set(i, points.reflectance.x[i] * pdf, points.reflectance.y[i] * pdf,
                      points.reflectance.z[i] * pdf);
    samples.bsdf_pdf[i] = pdf;
  }
}

DUET_WIDEST void sample_diffuse(int n, const WidePaths& paths, const WidePoints& points,
                                const WideNumbers& numbers, WideScattering& out) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Normal3f ns = points.ns.normal(i);
    const float side =
        PlainDiffuse::lit_side(-dot(ns, paths.ray.direction.vector(i)), points.two_sided[i] != 0);
    const Vector3f wi = square_to_cosine_hemisphere({numbers.x[i], numbers.y[i]});
    Vector3f s, t;
    coordinate_system(ns, s, t);
    const float z = wi.z * side;
    out.wi.set(i, s.x * wi.x + t.x * wi.y + ns.x * z, s.y * wi.x + t.y * wi.y + ns.y * z,
               s.z * wi.x + t.z * wi.y + ns.z * z);
    out.weight.set(i, points.reflectance.x[i], points.reflectance.y[i], points.reflectance.z[i]);
    out.pdf[i] = wi.z * kInvPi;
    out.eta[i] = 1;
    out.roulette[i] = numbers.first[i];
    const int32_t lit = side != 0 ? 1 : 0;
    out.alive[i] = wi.z > 0 ? lit : 0;
    out.null[i] = 0;
  }
}

DUET_WIDEST void weigh_light_samples(int n, const WidePaths& paths, const WidePoints& points,
                                     const WideLightSamples& samples, WideShadowRays& out) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const float pdf = samples.pdf[i], probability = samples.probability[i];
    const float heuristic = power_heuristic(pdf, samples.bsdf_pdf[i]);
    const float weight = (samples.delta[i] != 0 ? 1.0f : heuristic) / probability;
    const float r = samples.value.x[i], g = samples.value.y[i], b = samples.value.z[i];
    out.contribution.set(i, paths.throughput.x[i] * (r * samples.weight.x[i] * weight),
                         paths.throughput.y[i] * (g * samples.weight.y[i] * weight),
                         paths.throughput.z[i] * (b * samples.weight.z[i] * weight));
    const int32_t black = r == 0 ? (g == 0 ? (b == 0 ? 1 : 0) : 0) : 0;
    out.blocked[i] = pdf < 0 ? 1 : black;
    out.id[i] = paths.id[i];
    set_shadow_ray(i, points, samples, out.ray);
  }
}

namespace {

template <bool kRoulette>
[[gnu::always_inline]] inline void continue_paths(int n, Roulette roulette,
                                                  const WidePoints& points,
                                                  WideScattering& scattering, WidePaths& paths) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const float r = paths.throughput.x[i] * scattering.weight.x[i],
                g = paths.throughput.y[i] * scattering.weight.y[i],
                b = paths.throughput.z[i] * scattering.weight.z[i];
    const float importance = std::max(std::max(r, g), b);
    const float eta = paths.eta[i] * scattering.eta[i];
    int32_t alive = scattering.alive[i];
    alive = importance > 0 ? alive : 0;
    float scale = 1;
    if constexpr (kRoulette) {
      const float survival = roulette.probability(importance * eta * eta);
      alive = scattering.roulette[i] < survival ? alive : 0;
      scale = 1 / survival;
    }
    scattering.alive[i] = alive;
    paths.throughput.set(i, r * scale, g * scale, b * scale);
    paths.eta[i] = eta;
    paths.bsdf_pdf[i] = scattering.pdf[i];
    const Point3f position = points.position.point(i);
    const Vector3f ng = points.ng.vector(i), wi = scattering.wi.vector(i);
    paths.from.set(i, position);
    paths.ray.origin.set(i, moved_off(position, ng, points.offset[i], dot(ng, wi)));
    paths.ray.direction.set(i, wi);
    paths.ray.tmax[i] = INFINITY;
  }
}

}  // namespace

DUET_WIDEST void go_on(int n, const std::optional<Roulette>& roulette, const WidePoints& points,
                       WideScattering& scattering, WidePaths& paths) {
  if (roulette)
    continue_paths<true>(n, *roulette, points, scattering, paths);
  else
    continue_paths<false>(n, {}, points, scattering, paths);
}

}  // namespace duet
