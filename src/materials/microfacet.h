// Rough surfaces as a distribution of smooth facets: how many face where, how much of them is seen.
//
// Directions are unit vectors in the local frame; microfacet normals and the directions `o` and `i`
// that densities are asked for lie in the upper hemisphere unless said otherwise.
// Sources: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007; Heitz,
// "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014.
#pragma once

#include "materials/beckmann.h"
#include "materials/microfacet_kind.h"

namespace duet {

/// Directions that are closer to the horizon scatter nothing: their half vectors have lost all
/// digits.
inline constexpr float kMinCosine = 1e-6f;

/// Gaussian (Beckmann) or Trowbridge-Reitz (GGX) facets with roughness alpha along x and y.
class Microfacet {
 public:
  /// Rougher than a mirror by what Mitsuba demands at least.
  static constexpr float kMinAlpha = 1e-4f;

  Microfacet() = default;
  Microfacet(MicrofacetDistribution distribution, float alpha_u, float alpha_v, bool sample_visible)
      : alpha_u_(std::max(alpha_u, kMinAlpha)),
        alpha_v_(std::max(alpha_v, kMinAlpha)),
        inv_u_(1 / alpha_u_),
        inv_v_(1 / alpha_v_),
        ggx_(distribution != MicrofacetDistribution::beckmann),
        correlated_(distribution == MicrofacetDistribution::ggx_correlated),
        visible_(sample_visible) {}

  bool samples_visible() const { return visible_; }
  bool is_visible_ggx() const { return ggx_ && visible_ && !correlated_; }
  bool is_visible_beckmann() const { return !ggx_ && visible_; }
  /// The facets if they are Beckmann's.
  [[gnu::always_inline]] BeckmannFacets beckmann() const {
    return {alpha_u_, alpha_v_, inv_u_, inv_v_};
  }
  float alpha_u() const { return alpha_u_; }
  float alpha_v() const { return alpha_v_; }
  /// Along x or y.
  bool is_nearly_specular() const { return std::min(alpha_u_, alpha_v_) < float(kNearlySpecular); }

  /// Area of facets with normal m per surface area and solid angle.
  float density(const Vector3f& m) const { return ggx_ ? ggx_density(m) : beckmann().density(m); }

  /// Smith's masking function: the share of facets facing v that v sees.
  float masking(const Vector3f& v) const { return ggx_ ? ggx_masking(v) : beckmann().masking(v); }

  /// The share of facets that i sees of those that o sees: masking(i), or G₂ / G₁(o) if the two are
  /// correlated.
  float shadowing(const Vector3f& o, const Vector3f& i) const {
    if (!correlated_) return masking(i);
    const float near = std::abs(i.z), far = stretched_length(o);
    return (o.z + far) * near / (far * near + o.z * stretched_length(i));
  }

  /// What value and density of reflection and refraction have in common: for a half vector h,
  ///   value   = D(h) G₁(o) G₁(i) / o.z, or D(h) G₂(o, i) / o.z,
  ///   density = the density of h when sampled from o, over (o·h).
  using Core = BeckmannFacets::Core;
  Core core(const Vector3f& o, const Vector3f& i, const Vector3f& h) const {
    if (!visible_) {
      const float d = density(h);
      return {d * masking(o) * shadowing(o, i) / o.z, d * h.z / dot(o, h)};
    }
    if (!ggx_) return beckmann_core(o, i, h);
    const float seen = seen_ggx(o, h);
    return {seen * shadowing(o, i), seen};
  }
  /// The same for visible GGX facets without correlation.
  [[gnu::always_inline]] Core visible_ggx_core(const Vector3f& o, const Vector3f& i,
                                               const Vector3f& h) const {
    const float seen = seen_ggx(o, h);
    return {seen * ggx_masking(i), seen};
  }

  /// Reflection from o to i: a quarter of the core's value and density, both per solid angle of i,
  /// and the cosine o·h.
  struct Reflection {
    float value, density, cosine;
  };
  Reflection reflection(const Vector3f& o, const Vector3f& i) const {
    if (is_visible_ggx()) return visible_ggx_reflection(o, i);
    return reflection_by(o, i, [&](const Vector3f& h) { return core(o, i, h); });
  }
  /// The same, given the core of a half vector.
  template <class F>
  [[gnu::always_inline]] static Reflection reflection_by(const Vector3f& o, const Vector3f& i,
                                                         F&& core_of) {
    const Vector3f sum = o + i;
    const float length = std::sqrt(length_squared(sum));
    const Core c = core_of(sum * (1 / length));
    return {0.25f * c.value, 0.25f * c.density, 0.5f * length};
  }
  /// The same for visible GGX facets without correlation, with two divisions made one.
  [[gnu::always_inline]] Reflection visible_ggx_reflection(const Vector3f& o,
                                                           const Vector3f& i) const {
    const Vector3f sum = o + i;
    const float length2 = length_squared(sum);
    const float x = sum.x * inv_u_, y = sum.y * inv_v_;
    const float far = sqr(x * x + y * y + sum.z * sum.z) * (o.z + stretched_length(o));
    const float near = i.z + stretched_length(i);
    const float inverse = 1 / (far * near);
    const float density = 0.5f * kInvPi * inv_u_ * inv_v_ * sqr(length2) * near * inverse;
    return {density * (2 * i.z * far * inverse), density, 0.5f * std::sqrt(length2)};
  }

  /// A facet normal seen from o. Visible normals have the density G₁(o) D(m) (o·m)⁺ / o.z, others
  /// D(m) m.z. Neighbouring numbers make neighbouring normals.
  Vector3f sample(const Vector3f& o, const Point2f& u) const {
    if (!visible_) return sample_all(u);
    return ggx_ ? sample_visible_ggx(o, u) : sample_visible_beckmann(o, u);
  }
  Vector3f sample_visible_ggx(const Vector3f& o, const Point2f& u) const;

  /// The distribution from which a rough dielectric samples if it does not sample visible normals:
  /// somewhat wider, so that no weight becomes very large.
  /// Source: Walter et al. 2007, section 5.3.
  Microfacet widened(float cos_o) const {
    const float s = 1.2f - 0.2f * std::sqrt(std::abs(cos_o));
    Microfacet wide(*this);
    wide.alpha_u_ = alpha_u_ * s, wide.alpha_v_ = alpha_v_ * s;
    wide.inv_u_ = 1 / wide.alpha_u_, wide.inv_v_ = 1 / wide.alpha_v_;
    return wide;
  }

 private:
  [[gnu::always_inline]] float stretched_length(const Vector3f& v) const {
    return std::sqrt(sqr(alpha_u_ * v.x) + sqr(alpha_v_ * v.y) + v.z * v.z);
  }
  [[gnu::always_inline]] float ggx_density(const Vector3f& m) const {
    const float x = m.x * inv_u_, y = m.y * inv_v_, z2 = m.z * m.z;
    return kInvPi * inv_u_ * inv_v_ / sqr(x * x + y * y + z2);
  }
  [[gnu::always_inline]] float ggx_masking(const Vector3f& v) const {
    const float z = std::abs(v.z), across2 = sqr(alpha_u_ * v.x) + sqr(alpha_v_ * v.y);
    return 2 * z / (z + std::sqrt(z * z + across2));
  }
  /// The same as D(h) G₁(o) / o.z, without dividing by a vanishing cosine.
  [[gnu::always_inline]] float seen_ggx(const Vector3f& o, const Vector3f& h) const {
    return 2 * ggx_density(h) / (o.z + stretched_length(o));
  }
  // Not inlined: there is much of it.
  Core beckmann_core(const Vector3f& o, const Vector3f& i, const Vector3f& h) const;
  Vector3f sample_all(const Point2f& u) const;
  Vector3f sample_visible_beckmann(const Vector3f& o, const Point2f& u) const;

  float alpha_u_, alpha_v_, inv_u_, inv_v_;
  bool ggx_, correlated_, visible_;
};

/// Source: Dupuy & Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023. The
/// reflections about the facets of a (stretched) hemisphere fill a spherical cap evenly. Here the
/// sphere has the radius to which o is stretched, which saves to normalise it.
[[gnu::always_inline]] inline Vector3f Microfacet::sample_visible_ggx(const Vector3f& o,
                                                                      const Point2f& u) const {
  const float radius = stretched_length(o);
  // r² of a point on the disk is uniform and gives the height on the cap.
  const Point2f p = square_to_disk(u);
  const float up = radius + o.z, h = std::max(1 - p.x * p.x - p.y * p.y, 0.0f) * up;
  const float scale = std::sqrt(up * (radius + h - o.z));
  return normalize(Vector3f(alpha_u_ * (p.x * scale + alpha_u_ * o.x),
                            alpha_v_ * (p.y * scale + alpha_v_ * o.y), h));
}

}  // namespace duet
