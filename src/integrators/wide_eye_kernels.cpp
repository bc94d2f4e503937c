#include "integrators/wide_eye_kernels.h"

#include "base/instruction_sets.h"
#include "integrators/wide_kernels.h"
#include "transport/connection.h"

namespace duet {

namespace {

/// Roulette for what a connection contributes: nothing is left of those that it drops.
[[gnu::always_inline]] inline void set_contribution(int i, const Spectrum& value, float weight,
                                                    float threshold, float drawn,
                                                    WideShadowRays& out) {
  const float r = value.r * weight, g = value.g * weight, b = value.b * weight;
  const float most = std::max(std::max(r, g), b),
              unweighted = std::max(std::max(value.r, value.g), value.b);
  const float kept = ConnectionRoulette::keep(most, threshold, drawn);
  out.contribution.set(i, r * kept, g * kept, b * kept);
  // What is not a number is to be seen, and counted; but not the weight of nothing, which a surface
  // without a normal may have.
  const int32_t dropped = kept > 0 ? 0 : 1, nothing = most <= 0 ? 1 : dropped;
  out.blocked[i] = unweighted <= 0 ? WideShadowRays::kNothing : nothing;
}

}  // namespace

DUET_WIDEST void weigh_light_samples(int n, const WideConnections& c,
                                     const WideLightSamples& samples, WideShadowRays& out) {
  const WideConnections all = c;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Point3f position = all.points.position.point(i), target = samples.target.point(i);
    const Vector3f ng = all.points.ng.vector(i), wi = samples.wi.vector(i),
                   away = target - position;
    const bool finite = samples.finite[i] != 0, delta = samples.delta[i] != 0;
    const float pdf = samples.pdf[i], probability = samples.probability[i];
    const float d2 = length_squared(away), delta_density = (finite ? d2 : 1.0f) * probability;
    const float direct = delta ? delta_density : pdf;
    const float delta_d2 = delta && finite ? d2 : INFINITY;
    const float hit = delta ? 0.0f : samples.bsdf_pdf[i];
    const float arrival = samples.emission[i] * std::abs(dot(ng, wi)) / direct;
    const float merge_term = all.eye.merges[i] != 0 ? all.eye.merge_term[i] : 0.0f;
    const float gain = LightSampleVariance::gain(
        LightSampleVariance::others_of(LightSampleVariance::certain(delta, finite) * probability),
        LightSampleVariance::distance_of(delta_d2), all.camera_scale * all.subpaths.vcm[i]);
    const float weight = 1 / (1 + hit / direct +
                              all.share / (all.first ? gain : 1.0f) *
                                  beyond(arrival, merge_term, all.subpaths.vcm[i],
                                         all.eye.reverse[i], all.eye.sum[i]));
    const float inverse = 1 / probability;
    const Spectrum value(
        all.paths.throughput.x[i] * samples.value.x[i] * samples.weight.x[i] * inverse,
        all.paths.throughput.y[i] * samples.value.y[i] * samples.weight.y[i] * inverse,
        all.paths.throughput.z[i] * samples.value.z[i] * samples.weight.z[i] * inverse);
    set_contribution(i, value, weight, all.threshold,
                     ConnectionRoulette::draw(all.eye.roulette[i], all.connection), out);
    out.varying[i] = all.share * arrival * all.eye.reverse[i] * all.subpaths.vm[i] * weight;
    out.blocked[i] = pdf < 0 ? 1 : out.blocked[i];
    out.id[i] = all.paths.id[i];
    set_shadow_ray(i, all.points, samples, out.ray);
  }
}

namespace {

constexpr int kVertexNumbers = sizeof(ConnectionVertex) / sizeof(float);
static_assert(kVertexNumbers == 22);

/// See flat_light_at() (wide_lights.cpp).
struct GatheredVertex {
  Point3f position;
  float offset;
  Vector3f ng, lit;
  float flux[3], reverse, adjoint, vcm, vc, vm;
  int32_t depth;
};
[[gnu::always_inline]] inline GatheredVertex vertex_at(const float* f, int i) {
  GatheredVertex v;
  v.position = Point3f(f[i], f[i + 1], f[i + 2]);
  v.offset = f[i + 3];
  v.ng = Vector3f(f[i + 4], f[i + 5], f[i + 6]);
  v.lit = Vector3f(f[i + 7], f[i + 8], f[i + 9]);
  v.flux[0] = f[i + 10], v.flux[1] = f[i + 11], v.flux[2] = f[i + 12];
  v.reverse = f[i + 13], v.adjoint = f[i + 14];
  v.vcm = f[i + 15], v.vc = f[i + 16], v.vm = f[i + 17];
  v.depth = std::bit_cast<int32_t>(f[i + 18]);
  return v;
}

}  // namespace

DUET_WIDEST void find_directions(int n, const WidePairs& pairs, const WidePoints& points,
                                 const ConnectionVertex* light, BatchTriples& out) {
  const float* const numbers = &light->position.x;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int l = pairs.light[k] * kVertexNumbers;
    const Vector3f d =
        Point3f(numbers[l], numbers[l + 1], numbers[l + 2]) - points.position.point(pairs.eye[k]);
    out.set(k, d * (1 / std::sqrt(length_squared(d))));
  }
}

namespace {

/// `both.eye(k, i, direction)` is of pair k, whose eye vertex is i, `both.light(k, vertex, cosine)`
/// of the other end.
template <class F>
[[gnu::always_inline]] inline void weigh_all_pairs(int n, const WidePairs& pairs,
                                                   const WideConnections& c,
                                                   const ConnectionVertex* light, const F& both,
                                                   WideShadowRays& out) {
  const float* const numbers = &light->position.x;
  const WideConnections all = c;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = pairs.eye[k];
    const GatheredVertex l = vertex_at(numbers, pairs.light[k] * kVertexNumbers);
    const Point3f position = all.points.position.point(i);
    const Vector3f ng = all.points.ng.vector(i);
    const Vector3f d = l.position - position;
    const float d2 = length_squared(d), inverse_d2 = 1 / d2;
    const Vector3f to_light = d * (1 / std::sqrt(d2));
    const float cosine = -dot(l.lit, to_light);
    const Scattered f = both.eye(k, i, to_light), g = both.light(k, l, cosine);
    const float eye_geometric = dot(ng, to_light), light_geometric = -dot(l.ng, to_light);
    const float ratio = l.adjoint * std::abs(light_geometric / cosine);
    const float adjoint = cosine != 0 ? ratio : 0.0f;
    // Both vertices merge, if the pixel does: neither is nearly specular.
    const float merge_term = all.eye.merge_term[i];
    const float light_sum = all.eye.unmerged[i] != 0 ? l.vm : l.vc;
    const float light_arrival = f.pdf * std::abs(light_geometric) * inverse_d2 * all.eye_paths,
                eye_arrival = g.pdf * std::abs(eye_geometric) * inverse_d2;
    const float weight =
        1 / (1 + beyond(light_arrival, merge_term, l.vcm, g.reverse, light_sum) +
             beyond(eye_arrival, merge_term, all.subpaths.vcm[i], f.reverse, all.eye.sum[i]));
    out.varying[k] = eye_arrival * f.reverse * all.subpaths.vm[i] * weight;
    const float scale = adjoint * inverse_d2 * all.scale;
    const Spectrum value(f.r * g.r * scale, f.g * g.g * scale, f.b * g.b * scale);
    set_contribution(k, value, weight, all.threshold,
                     ConnectionRoulette::draw(all.eye.roulette[i],
                                              all.connection + uint32_t(l.depth) + pairs.drawn[k]),
                     out);
    out.id[k] = all.paths.id[i];
    const Point3f target = moved_off(l.position, l.ng, l.offset, light_geometric);
    const Point3f origin =
        moved_off(position, ng, all.points.offset[i], dot(ng, target - position));
    out.ray.origin.set(k, origin);
    out.ray.direction.set(k, target - origin);
    out.ray.tmax[k] = 0x1.fffep-1f;
  }
}

/// The ends of pairs, by what their vertices are.
struct DiffuseEye {
  const WideEnds& ends;
  [[gnu::always_inline]] Scattered eye(int, int i, const Vector3f& to_light) const {
    return scattered_diffusely(ends, i, to_light);
  }
};
struct DiffuseLight {
  [[gnu::always_inline]] Scattered light(int, const GatheredVertex& l, float cosine) const {
    // Vertices that faced each other may not do so by the unit direction.
    const float pdf = std::max(0.0f, cosine * kInvPi);
    return {l.flux[0] * pdf, l.flux[1] * pdf, l.flux[2] * pdf, pdf, l.reverse};
  }
};
struct DiffusePairs : DiffuseEye, DiffuseLight {};

struct GlossyEyePairs : DiffuseLight {
  const WidePaths& paths;
  const WideGlossy& glossy;
  [[gnu::always_inline]] Scattered eye(int k, int i, const Vector3f&) const {
    return {paths.throughput.x[i] * glossy.value.x[k], paths.throughput.y[i] * glossy.value.y[k],
            paths.throughput.z[i] * glossy.value.z[k], glossy.value_pdf[k], glossy.reverse[k]};
  }
};

struct GlossyLightPairs {
  const WideConnections& c;
  const WideGlossyEnds& ends;
  [[gnu::always_inline]] Scattered eye(int k, int i, const Vector3f& to_light) const {
    const Scattered diffuse = scattered_diffusely(c.eye, i, to_light);
    const Scattered glossy = scattered(ends.eye, k, c.paths.throughput, i);
    const bool is_diffuse = ends.eye.material[k] == ConnectionVertex::kDiffuse;
    return {is_diffuse ? diffuse.r : glossy.r, is_diffuse ? diffuse.g : glossy.g,
            is_diffuse ? diffuse.b : glossy.b, is_diffuse ? diffuse.pdf : glossy.pdf,
            is_diffuse ? diffuse.reverse : glossy.reverse};
  }
  [[gnu::always_inline]] Scattered light(int k, const GatheredVertex&, float) const {
    return scattered(ends.light, k, ends.light_throughput, k);
  }
};

}  // namespace

DUET_WIDEST void weigh_pairs(int n, const WidePairs& pairs, const WideConnections& c,
                             const ConnectionVertex* light, WideShadowRays& out) {
  weigh_all_pairs(n, pairs, c, light, DiffusePairs{{c.eye}, {}}, out);
}

DUET_WIDEST void weigh_glossy_pairs(int n, const WidePairs& pairs, const WideConnections& c,
                                    const ConnectionVertex* light, const WideGlossy& glossy,
                                    WideShadowRays& out) {
  weigh_all_pairs(n, pairs, c, light, GlossyEyePairs{{}, c.paths, glossy}, out);
}

DUET_WIDEST void weigh_glossy_ends(int n, const WidePairs& pairs, const WideConnections& c,
                                   const ConnectionVertex* light, const WideGlossyEnds& ends,
                                   WideShadowRays& out) {
  weigh_all_pairs(n, pairs, c, light, GlossyLightPairs{c, ends}, out);
}

}  // namespace duet
