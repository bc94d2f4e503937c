#include "materials/dielectric.h"

#include "materials/materials.h"

namespace duet {

namespace {

/// How much radiance is compressed by passing into a medium of relative index `eta`.
float compression(float eta, Transport transport) {
  return transport == Transport::radiance ? 1 / (eta * eta) : 1.0f;
}

}  // namespace

std::optional<ModelSample> DielectricModel::sample(const Vector3f& wo, float u, const Point2f&,
                                                   Transport transport) const {
  if (wo.z == 0) return std::nullopt;
  const bool below = wo.z < 0;
  const float relative = below ? 1 / eta : eta;
  const DielectricFresnel f = fresnel_dielectric(std::abs(wo.z), relative);
  const float p =
      reflection_probability(f.reflectance, specular_reflectance, specular_transmittance);
  if (u < p)
    return ModelSample{.wi = reflect(wo),
                       .weight = specular_reflectance * (f.reflectance / p),
                       .pdf = p,
                       .delta = true};
  const float transmitted = 1 - f.reflectance;
  if (!(transmitted > 0 && f.cos_t > 0) || specular_transmittance.is_black()) return std::nullopt;
  return ModelSample{
      .wi = {-wo.x / relative, -wo.y / relative, below ? f.cos_t : -f.cos_t},
      .weight = specular_transmittance * (transmitted / (1 - p) * compression(relative, transport)),
      .pdf = 1 - p,
      .eta = relative,
      .delta = true};
}

ModelEval RoughDielectricModel::eval(const Vector3f& wo, const Vector3f& wi,
                                     Transport transport) const {
  if (eta == 1 || std::abs(wo.z) < kMinCosine || std::abs(wi.z) < kMinCosine) return {};
  const bool below = wo.z < 0;
  const float relative = below ? 1 / eta : eta;
  const Vector3f o = mirrored(wo, below), i = mirrored(wi, below);
  const bool reflects = i.z > 0;
  Vector3f h = reflects ? o + i : o + i * relative;
  h = normalize(h.z < 0 ? -h : h);
  const float oh = dot(o, h), ih = dot(i, h);
  // A facet must be seen from the same side as the surface.
  if (!(h.z > 0 && oh > 0 && (reflects ? ih > 0 : ih < 0))) return {};
  Microfacet::Core core = microfacet.core(o, i, h);
  if (!microfacet.samples_visible()) core.density = microfacet.widened(o.z).density(h) * h.z / oh;
  const float f = fresnel_dielectric(oh, relative).reflectance;
  const float p = reflection_probability(f, specular_reflectance, specular_transmittance);
  if (reflects) return {specular_reflectance * (0.25f * f * core.value), 0.25f * p * core.density};
  // Solid angle of h per solid angle of wi, over |i·h| (eq. 17).
  const float jacobian = sqr(relative / (oh + relative * ih)) * oh * -ih;
  return {
      specular_transmittance * ((1 - f) * core.value * jacobian * compression(relative, transport)),
      (1 - p) * core.density * jacobian};
}

std::optional<ModelSample> RoughDielectricModel::sample(const Vector3f& wo, float u,
                                                        const Point2f& v,
                                                        Transport transport) const {
  if (eta == 1)
    return ModelSample{.wi = -wo, .weight = specular_transmittance, .pdf = 1, .delta = true};
  if (std::abs(wo.z) < kMinCosine) return std::nullopt;
  const bool below = wo.z < 0;
  const float relative = below ? 1 / eta : eta;
  const Vector3f o = mirrored(wo, below);
  const bool visible = microfacet.samples_visible();
  const Microfacet sampler = visible ? microfacet : microfacet.widened(o.z);
  const Vector3f m = sampler.sample(o, v);
  const float om = dot(o, m);
  if (!(m.z > 0 && om > 0)) return std::nullopt;
  const DielectricFresnel f = fresnel_dielectric(om, relative);
  const float p =
      reflection_probability(f.reflectance, specular_reflectance, specular_transmittance);
  const bool reflects = u < p;
  const Vector3f i = reflects ? reflect(o, m) : m * (om / relative - f.cos_t) - o * (1 / relative);
  if (!(reflects ? i.z > kMinCosine : i.z < -kMinCosine)) return std::nullopt;
  const float im = dot(i, m);
  const Microfacet::Core core = microfacet.core(o, i, m);
  const float density = visible ? core.density : sampler.density(m) * m.z / om;
  if (!(density > 0)) return std::nullopt;
  const float ratio = core.value / density;
  ModelSample s;
  s.wi = mirrored(i, below);
  if (reflects) {
    s.weight = specular_reflectance * (ratio * f.reflectance / p);
    s.pdf = 0.25f * p * density;
    return s;
  }
  const float transmitted = 1 - f.reflectance;
  if (!(transmitted > 0 && im < 0)) return std::nullopt;
  s.weight =
      specular_transmittance * (ratio * transmitted / (1 - p) * compression(relative, transport));
  s.pdf = (1 - p) * density * sqr(relative / (om + relative * im)) * om * -im;
  s.eta = relative;
  if (!(s.pdf > 0)) return std::nullopt;
  return s;
}

namespace {

/// An index of zero or less means nothing, but a texture can contain it.
float valid_eta(float eta) {
  return std::clamp(eta, 1e-2f, 1e2f);
}

bool is_constant(const DielectricOptions& o) {
  return all_constant(o.eta, o.specular_reflectance, o.specular_transmittance);
}

bool needs_uv(const DielectricOptions& o) {
  return any_needs_uv(o.eta, o.specular_reflectance, o.specular_transmittance);
}

}  // namespace

Dielectric::Dielectric(const DielectricOptions& options) : options_(options) {
  if (is_constant(options)) set_constant(model({}));
}

DielectricModel Dielectric::model(const Surface& s) const {
  return {valid_eta(options_.eta(s)), options_.specular_reflectance(s),
          options_.specular_transmittance(s)};
}

SurfaceNeeds Dielectric::needs() const {
  return {.uv = needs_uv(options_)};
}

RoughDielectric::RoughDielectric(const DielectricOptions& options,
                                 const RoughnessOptions& roughness)
    : options_(options), roughness_(roughness) {
  if (is_constant(options) && all_constant(roughness.alpha_u, roughness.alpha_v))
    set_constant(model({}));
}

RoughDielectricModel RoughDielectric::model(const Surface& s) const {
  return {roughness_(s), valid_eta(options_.eta(s)), options_.specular_reflectance(s),
          options_.specular_transmittance(s)};
}

SurfaceNeeds RoughDielectric::needs() const {
  return roughness_.needs() | SurfaceNeeds{.uv = needs_uv(options_)};
}

ThinDielectric::ThinDielectric(const DielectricOptions& options) : options_(options) {
  if (is_constant(options)) set_constant(model({}));
}

ThinDielectricModel ThinDielectric::model(const Surface& s) const {
  return {valid_eta(options_.eta(s)), options_.specular_reflectance(s),
          options_.specular_transmittance(s)};
}

SurfaceNeeds ThinDielectric::needs() const {
  return {.uv = needs_uv(options_)};
}

}  // namespace duet
