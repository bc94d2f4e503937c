#include "materials/layered.h"

#include <bit>
#include <tuple>

#include "materials/layer_walk.h"
#include "math/hash.h"
#include "math/warp.h"

namespace duet {

namespace {

uint32_t bits(float x) {
  return std::bit_cast<uint32_t>(x);
}

uint64_t hash_direction(uint64_t seed, const Vector3f& w) {
  return hash_combine(hash_combine(seed, uint64_t(bits(w.x)) << 32 | bits(w.y)), bits(w.z));
}

bool comes_first(const Vector3f& a, const Vector3f& b) {
  return std::tie(a.z, a.x, a.y) < std::tie(b.z, b.x, b.y);
}

}  // namespace

float LayeredModel::nearly_specular_share() const {
  if (is_mirror()) return 0;
  const Lobes l = lobes(1);
  const float all = l.coat + l.facets + l.diffuse;
  const float narrow =
      (coat.is_nearly_specular() ? l.coat : 0.0f) + (l.seen.is_nearly_specular() ? l.facets : 0.0f);
  return all > 0 ? narrow / all : 0.0f;
}

/// F + T² a² R Σ (a² R F)^k for mirrors, where a is what passes the layer: a geometric series.
Spectrum LayeredModel::mirror_coefficient(float cosine) const {
  const DielectricFresnel f = fresnel_dielectric(cosine, eta);
  if (!is_mirror() || !(f.reflectance < 1)) return Spectrum(f.reflectance);
  const Spectrum r = fresnel_conductor(f.cos_t, base, base_k) *
                     std::exp(-2 * thickness / std::max(f.cos_t, 1e-6f));
  Spectrum term = r * sqr(1 - f.reflectance), sum(f.reflectance);
  for (int event = 0; event < max_depth; event += 2) {
    sum += term;
    term *= r * f.reflectance;
  }
  return sum;
}

LayeredModel::Lobes LayeredModel::lobes(float cosine) const {
  const DielectricFresnel f = fresnel_dielectric(cosine, eta);
  const float crossing = std::exp(-thickness / std::max(f.cos_t, 1e-6f));
  const float passed = (1 - f.reflectance) * crossing;
  const float scattered = (1 - f.reflectance) * (1 - crossing) * albedo.mean();
  Lobes l;
  l.mirrored = mirror_coefficient(cosine);
  if (smooth_coat)
    l.mirror = l.mirrored.mean();
  else
    l.coat = f.reflectance;
  if (has_smooth()) {
    l.diffuse = scattered + (is_metal ? 0.0f : passed * base.mean());
    if (is_metal && !is_mirror()) {
      l.facets = passed * fresnel_conductor(f.cos_t, base, base_k).mean();
      // By how much a tilted facet turns light, outside the coat: the metal's once, the coat's on
      // the way in and on the way out.
      const float z = std::max(cosine, 1e-3f), inside = eta * f.cos_t;
      const auto alpha = [&](float of_metal, float of_coat) {
        const float a = smooth_base ? 0.0f : inside * of_metal;
        const float b = smooth_coat ? 0.0f : (inside - z) * of_coat;
        return std::min(std::sqrt(a * a + 0.5f * b * b) / z, 1.0f);
      };
      l.seen = Microfacet(MicrofacetDistribution::ggx, alpha(metal.alpha_u(), coat.alpha_u()),
                          alpha(metal.alpha_v(), coat.alpha_v()), true);
    }
    // Light that is reflected to and fro may go anywhere.
    l.diffuse = std::max(l.diffuse, 0.1f * (1 - l.mirror) + 0.01f);
  }
  const float all = l.mirror + l.coat + l.facets + l.diffuse;
  if (all > 0) l.mirror /= all, l.coat /= all, l.facets /= all, l.diffuse /= all;
  return l;
}

Spectrum LayeredModel::from_below(const Vector3f& wo, const Vector3f& wi) const {
  const bool swap = comes_first(wi, wo);
  const Vector3f &a = swap ? wi : wo, &b = swap ? wo : wi;
  LayerWalk walk(*this, hash_direction(hash_direction(seed, a), b));
  Spectrum sum;
  for (int i = 0; i < samples; ++i) sum += walk.estimate(a, b);
  // Radiance is compressed by the coat's index, which it has on one of its two ways through.
  return sum * (1 / (float(samples) * eta * eta));
}

ModelEval LayeredModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine) || !has_smooth()) return {};
  Spectrum value = from_below(wo, wi) * wi.z;
  if (!smooth_coat) {
    const Microfacet::Reflection r = coat.reflection(wo, wi);
    value += Spectrum(fresnel_dielectric(r.cosine, eta).reflectance * r.value);
  }
  return {value, density(wo, wi)};
}

float LayeredModel::density(const Vector3f& wo, const Vector3f& wi) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine) || !has_smooth()) return 0;
  const Lobes l = lobes(wo.z);
  float sum = l.diffuse * wi.z * kInvPi;
  if (l.coat > 0) sum += l.coat * coat.reflection(wo, wi).density;
  if (l.facets > 0) sum += l.facets * l.seen.reflection(wo, wi).density;
  return sum;
}

std::optional<ModelSample> LayeredModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                                Transport transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  const Lobes l = lobes(wo.z);
  if (u < l.mirror || !has_smooth()) {
    if (!(l.mirror > 0)) return std::nullopt;
    return ModelSample{
        .wi = reflect(wo), .weight = l.mirrored / l.mirror, .pdf = l.mirror, .delta = true};
  }
  u -= l.mirror;
  Vector3f wi;
  if (u < l.coat)
    wi = reflect(wo, coat.sample(wo, v));
  else if (u < l.coat + l.facets)
    wi = reflect(wo, l.seen.sample(wo, v));
  else
    wi = square_to_cosine_hemisphere(v);
  return sample_from(eval(wo, wi, transport), wi);
}

}  // namespace duet
