#include "materials/layered_material.h"

#include <bit>

#include "math/hash.h"

namespace duet {

namespace {

bool is_smooth_at(float alpha_u, float alpha_v) {
  return std::max(alpha_u, alpha_v) < CoatLayerOptions::kSmoothAlpha;
}

bool same_slot(const FloatSlot& a, const FloatSlot& b) {
  return a.texture == b.texture && (a.texture || a.constant == b.constant);
}

uint32_t hash_of(const Point3f& p) {
  uint64_t h = 0;
  for (const float x : {p.x, p.y, p.z}) h = hash_combine(h, std::bit_cast<uint32_t>(x));
  return uint32_t(h);
}

Spectrum fraction_of(const Spectrum& c) {
  const auto clamp = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
  return {clamp(c.r), clamp(c.g), clamp(c.b)};
}

/// The k that reflects r along the normal where η = 1; infinite for r = 1.
Spectrum extinction_of(const Spectrum& reflectance) {
  const auto k = [](float r) {
    r = std::clamp(r, 0.0f, 0.9999f);
    return 2 * std::sqrt(r / (1 - r));
  };
  return {k(reflectance.r), k(reflectance.g), k(reflectance.b)};
}

}  // namespace

bool CoatLayerOptions::has_closed_form() const {
  return same_slot(alpha_u, alpha_v) && thickness.is_constant() && albedo.is_constant() &&
         albedo.constant.is_black();
}

SurfaceNeeds CoatLayerOptions::needs() const {
  return {.uv = any_needs_uv(alpha_u, alpha_v, thickness, albedo, g),
          .tangents = !same_slot(alpha_u, alpha_v)};
}

LayeredModel CoatLayerOptions::model(const Surface& s) const {
  LayeredModel m{};
  const float u = alpha_u(s), v = alpha_v(s);
  m.coat = Microfacet(MicrofacetDistribution::ggx_correlated, u, v, true);
  m.metal = m.coat;
  m.eta = eta;
  m.thickness = std::max(thickness(s), 0.0f);
  m.g = std::clamp(g(s), -0.99f, 0.99f);
  m.albedo = fraction_of(albedo(s));
  m.seed = hash_of(s.position);
  m.max_depth = uint16_t(std::min(max_depth, 0xffff));
  m.samples = uint16_t(std::min(samples, 0xffff));
  // Facets without a change of index do nothing.
  m.smooth_coat = is_smooth_at(u, v) || eta == 1;
  return m;
}

CoatedDiffuse::CoatedDiffuse(const ColorSlot& reflectance, const CoatLayerOptions& options)
    : reflectance_(reflectance), options_(options) {
  if (!options.has_closed_form()) return;
  const float thickness = options.thickness.constant;
  smooth_shares_ = smooth_coat_shares(options.eta, thickness);
  const FloatSlot& alpha = options.alpha_u;
  if (!alpha.is_constant())
    tables_.emplace(options.eta, thickness);
  else if (!is_smooth_at(alpha.constant, alpha.constant))
    tables_.emplace(options.eta, thickness, alpha.constant);
  if (all_constant(reflectance, alpha)) set_constant(closed_model({}));
}

SurfaceNeeds CoatedDiffuse::needs() const {
  return options_.needs() | SurfaceNeeds{.uv = reflectance_.needs_uv()};
}

CoatedDiffuseModel CoatedDiffuse::closed_model(const Surface& s) const {
  CoatedDiffuseModel m{};
  const float alpha = options_.alpha_u(s);
  m.coat = Microfacet(MicrofacetDistribution::ggx_correlated, alpha, alpha, true);
  m.eta = options_.eta;
  m.thickness = options_.thickness.constant;
  m.smooth = is_smooth_at(alpha, alpha) || m.eta == 1;
  CoatDiffuseShares shares = smooth_shares_;
  if (!m.smooth) {
    const CoatTransmittance::Lookup lookup = (*tables_)(alpha);
    m.row = lookup.row;
    shares = lookup.shares;
  }
  m.base = coated_base(fraction_of(reflectance_(s)), shares.returned, m.eta, options_.max_depth);
  m.base_weight = m.base.mean() * shares.received;
  return m;
}

LayeredModel CoatedDiffuse::walk_model(const Surface& s) const {
  LayeredModel m = options_.model(s);
  m.base = fraction_of(reflectance_(s));
  m.smooth_base = m.is_metal = false;
  return m;
}

void CoatedDiffuse::add_components(const Surface& surface, BsdfBuilder& builder) const {
  if (options_.has_closed_form())
    builder.add(closed_model(surface));
  else
    builder.add(walk_model(surface));
}

CoatedConductor::CoatedConductor(const CoatedMetalOptions& metal, const CoatLayerOptions& options)
    : metal_(metal), options_(options) {}

LayeredModel CoatedConductor::model(const Surface& s) const {
  LayeredModel m = options_.model(s);
  const float u = metal_.alpha_u(s), v = metal_.alpha_v(s);
  m.metal = Microfacet(MicrofacetDistribution::ggx_correlated, u, v, true);
  m.smooth_base = is_smooth_at(u, v);
  m.is_metal = true;
  const bool by_color = metal_.reflectance.has_value();
  const Spectrum eta = by_color ? Spectrum(1) : metal_.eta(s);
  const Spectrum k = by_color ? extinction_of((*metal_.reflectance)(s)) : metal_.k(s);
  m.base = bounded_index(eta / m.eta);
  m.base_k = bounded_index(k / m.eta);
  return m;
}

SurfaceNeeds CoatedConductor::needs() const {
  SurfaceNeeds own{.uv = any_needs_uv(metal_.eta, metal_.k, metal_.alpha_u, metal_.alpha_v),
                   .tangents = !same_slot(metal_.alpha_u, metal_.alpha_v)};
  if (metal_.reflectance) own.uv |= metal_.reflectance->needs_uv();
  return options_.needs() | own;
}

Spectrum CoatedConductor::local_albedo(const Surface& s, const Vector3f&) const {
  if (metal_.reflectance) return (*metal_.reflectance)(s);
  return fresnel_conductor(1, bounded_index(metal_.eta(s)), bounded_index(metal_.k(s)));
}

}  // namespace duet
