#include "materials/conductor.h"

#include "materials/materials.h"

namespace duet {

ModelEval RoughConductorModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const Microfacet::Reflection r = microfacet.reflection(wo, wi);
  return {reflectance(r.cosine) * r.value, r.density};
}

std::optional<ModelSample> RoughConductorModel::sample(const Vector3f& wo, float, const Point2f& v,
                                                       Transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  const Vector3f m = microfacet.sample(wo, v);
  const float cosine = dot(wo, m);
  const Vector3f wi = reflect(wo, m);
  if (!(cosine > 0 && wi.z > kMinCosine)) return std::nullopt;
  const Microfacet::Core core = microfacet.core(wo, wi, m);
  if (!(core.density > 0)) return std::nullopt;
  return ModelSample{wi, reflectance(cosine) * (core.value / core.density), 0.25f * core.density};
}

namespace {

bool is_constant(const ConductorOptions& o) {
  return all_constant(o.eta, o.k, o.specular_reflectance);
}

bool needs_uv(const ConductorOptions& o) {
  return any_needs_uv(o.eta, o.k, o.specular_reflectance);
}

}  // namespace

Conductor::Conductor(const ConductorOptions& options) : options_(options) {
  if (is_constant(options)) set_constant(model({}));
}

ConductorModel Conductor::model(const Surface& s) const {
  return {bounded_index(options_.eta(s)), bounded_index(options_.k(s)),
          options_.specular_reflectance(s)};
}

SurfaceNeeds Conductor::needs() const {
  return {.uv = needs_uv(options_)};
}

RoughConductor::RoughConductor(const ConductorOptions& options, const RoughnessOptions& roughness)
    : options_(options), roughness_(roughness) {
  if (is_constant(options) && all_constant(roughness.alpha_u, roughness.alpha_v))
    set_constant(model({}));
}

RoughConductorModel RoughConductor::model(const Surface& s) const {
  const Spectrum eta = bounded_index(options_.eta(s));
  return {roughness_(s), eta, bounded_index(options_.k(s)), options_.specular_reflectance(s),
          eta.is_black()};
}

std::optional<RoughConductorModel> RoughConductor::uniform() const {
  if (!all_constant(options_.eta, options_.k, roughness_.alpha_u, roughness_.alpha_v))
    return std::nullopt;
  const Spectrum eta = bounded_index(options_.eta.constant);
  return RoughConductorModel{roughness_({}), eta, bounded_index(options_.k.constant), Spectrum(1),
                             eta.is_black()};
}

SurfaceNeeds RoughConductor::needs() const {
  return roughness_.needs() | SurfaceNeeds{.uv = needs_uv(options_)};
}

}  // namespace duet
