#include "materials/dielectric.h"

#include "materials/materials.h"

namespace duet {

namespace {

/// Facets of any kind. Those that are not sampled by what is seen of them are sampled somewhat
/// wider.
struct SampledFacets {
  const Microfacet& facets;

  Microfacet::Core core(const Vector3f& o, const Vector3f& i, const Vector3f& h) const {
    Microfacet::Core c = facets.core(o, i, h);
    if (!facets.samples_visible()) c.density = facets.widened(o.z).density(h) * h.z / dot(o, h);
    return c;
  }
  Vector3f sample(const Vector3f& o, const Point2f& v) const {
    return facets.samples_visible() ? facets.sample(o, v) : facets.widened(o.z).sample(o, v);
  }
};

}  // namespace

ModelEval RoughDielectricModel::eval(const Vector3f& wo, const Vector3f& wi,
                                     Transport transport) const {
  return eta == 1 ? ModelEval{} : eval_by(SampledFacets{microfacet}, wo, wi, transport);
}

std::optional<ModelSample> RoughDielectricModel::sample(const Vector3f& wo, float u,
                                                        const Point2f& v,
                                                        Transport transport) const {
  if (eta == 1)
    return ModelSample{.wi = -wo, .weight = specular_transmittance, .pdf = 1, .delta = true};
  return sample_by(SampledFacets{microfacet}, wo, u, v, transport).model_sample();
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
