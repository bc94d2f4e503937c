#include "materials/polarized_plastic.h"

#include "materials/fresnel.h"
#include "materials/special_materials.h"

namespace duet {

ModelEval PolarizedPlasticModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const Microfacet::Reflection r = microfacet.reflection(wo, wi);
  const float f = fresnel_dielectric(r.cosine, eta).reflectance;
  const float fo = fresnel_dielectric(wo.z, eta).reflectance;
  const float fi = fresnel_dielectric(wi.z, eta).reflectance;
  const float cosine = wi.z * kInvPi;
  return {specular * (f * r.value) + diffuse * ((1 - fo) * (1 - fi) * cosine),
          specular_probability * r.density + (1 - specular_probability) * cosine};
}

std::optional<ModelSample> PolarizedPlasticModel::sample(const Vector3f& wo, float u,
                                                         const Point2f& v,
                                                         Transport transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  const Vector3f wi = u < specular_probability ? reflect(wo, microfacet.sample(wo, v))
                                               : square_to_cosine_hemisphere(v);
  return sample_from(eval(wo, wi, transport), wi);
}

PolarizedPlastic::PolarizedPlastic(const PlasticOptions& options, const RoughnessOptions& roughness)
    : options_(options), roughness_(roughness) {
  if (all_constant(options.diffuse_reflectance, options.specular_reflectance, roughness.alpha_u,
                   roughness.alpha_v))
    set_constant(model({}));
}

PolarizedPlasticModel PolarizedPlastic::model(const Surface& s) const {
  const Spectrum diffuse = options_.diffuse_reflectance(s);
  const Spectrum specular = options_.specular_reflectance(s);
  const float sum = diffuse.mean() + specular.mean();
  return {roughness_(s), options_.eta, diffuse, specular, sum > 0 ? specular.mean() / sum : 0.0f};
}

SurfaceNeeds PolarizedPlastic::needs() const {
  return roughness_.needs() | SurfaceNeeds{.uv = any_needs_uv(options_.diffuse_reflectance,
                                                              options_.specular_reflectance)};
}

}  // namespace duet
