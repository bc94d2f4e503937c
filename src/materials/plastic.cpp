#include "materials/plastic.h"

#include "materials/materials.h"

namespace duet {

float RoughPlasticModel::nearly_specular_share() const {
  if (!microfacet.is_nearly_specular()) return 0;
  return lobe_probability(normal_reflectance(eta), specular_weight, diffuse_weight);
}

ModelEval RoughPlasticModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const Microfacet::Reflection r = microfacet.reflection(wo, wi);
  return eval_above(wo, wi, r, fresnel_dielectric(r.cosine, eta).reflectance);
}

std::optional<ModelSample> RoughPlasticModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                                     Transport transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  Vector3f wi;
  if (u < specular_probability(transmittance(wo.z))) {
    const Vector3f m = microfacet.sample(wo, v);
    wi = reflect(wo, m);
  } else {
    wi = square_to_cosine_hemisphere(v);
  }
  return sample_from(eval(wo, wi, transport), wi);
}

namespace {

bool is_constant(const PlasticOptions& o) {
  return all_constant(o.diffuse_reflectance, o.specular_reflectance);
}

bool needs_uv(const PlasticOptions& o) {
  return any_needs_uv(o.diffuse_reflectance, o.specular_reflectance);
}

RoughTransmittance make_tables(const PlasticOptions& o, const RoughnessOptions& r) {
  return r.alpha_u.is_constant() ? RoughTransmittance(r.distribution, o.eta, r.alpha_u.constant)
                                 : RoughTransmittance(r.distribution, o.eta);
}

}  // namespace

Plastic::Plastic(const PlasticOptions& options)
    : options_(options), internal_reflectance_(fresnel_diffuse_reflectance(1 / options.eta)) {
  if (is_constant(options)) set_constant(model({}));
}

PlasticModel Plastic::model(const Surface& s) const {
  return plastic(options_.specular_reflectance(s)).model(options_.diffuse_reflectance(s));
}

std::optional<UniformPlastic> Plastic::uniform() const {
  if (!options_.specular_reflectance.is_constant()) return std::nullopt;
  return plastic(options_.specular_reflectance.constant);
}

SurfaceNeeds Plastic::needs() const {
  return {.uv = needs_uv(options_)};
}

RoughPlastic::RoughPlastic(const PlasticOptions& options, const RoughnessOptions& roughness)
    : options_(options), roughness_(roughness), tables_(make_tables(options, roughness)) {
  roughness_.alpha_v = roughness_.alpha_u;
  if (is_constant(options) && roughness_.alpha_u.is_constant()) set_constant(model({}));
}

RoughPlasticModel RoughPlastic::model(const Surface& s) const {
  const Spectrum base = options_.diffuse_reflectance(s);
  const Spectrum specular = options_.specular_reflectance(s);
  const float alpha = roughness_.alpha_u(s);
  const RoughTransmittance::Lookup t = tables_(alpha);
  const UniformRoughPlastic plastic{
      Microfacet(roughness_.distribution, alpha, alpha, roughness_.sample_visible),
      options_.eta,
      specular,
      t.external,
      t.internal_reflectance,
      options_.nonlinear};
  return plastic.model(base);
}

std::optional<UniformRoughPlastic> RoughPlastic::uniform() const {
  if (!all_constant(options_.specular_reflectance, roughness_.alpha_u)) return std::nullopt;
  const float alpha = roughness_.alpha_u.constant;
  const Microfacet microfacet(roughness_.distribution, alpha, alpha, roughness_.sample_visible);
  const RoughTransmittance::Lookup t = tables_(alpha);
  return UniformRoughPlastic{
      microfacet, options_.eta,           options_.specular_reflectance.constant,
      t.external, t.internal_reflectance, options_.nonlinear};
}

SurfaceNeeds RoughPlastic::needs() const {
  return roughness_.needs() | SurfaceNeeds{.uv = needs_uv(options_)};
}

}  // namespace duet
