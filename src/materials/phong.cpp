#include "materials/phong.h"

#include "materials/fresnel.h"
#include "materials/materials.h"
#include "math/warp.h"

namespace duet {

ModelEval PhongModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > 0 && wi.z > 0)) return {};
  const float cosine = wi.z * kInvPi;
  const float alpha = dot(reflect(wo), wi);
  const float lobe = alpha > 0 ? std::pow(alpha, exponent) * (0.5f * kInvPi) : 0.0f;
  return {diffuse * cosine + specular * ((exponent + 2) * lobe * wi.z),
          specular_probability * (exponent + 1) * lobe + (1 - specular_probability) * cosine};
}

std::optional<ModelSample> PhongModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                              Transport transport) const {
  if (!(wo.z > 0)) return std::nullopt;
  Vector3f wi;
  if (u < specular_probability) {
    const float z = std::pow(1 - v.y, 1 / (exponent + 1)), r = safe_sqrt(1 - z * z);
    float sine, cosine;
    sincos_turns(v.x, sine, cosine);
    wi = Frame(Normal3f(reflect(wo))).to_world({r * cosine, r * sine, z});
  } else {
    wi = square_to_cosine_hemisphere(v);
  }
  return sample_from(eval(wo, wi, transport), wi);
}

Phong::Phong(const PhongOptions& options) : options_(options) {
  if (all_constant(options.diffuse_reflectance, options.specular_reflectance, options.exponent))
    set_constant(model({}));
}

PhongModel Phong::model(const Surface& s) const {
  const Spectrum diffuse = options_.diffuse_reflectance(s);
  const Spectrum specular = options_.specular_reflectance(s);
  return {diffuse, specular, std::max(options_.exponent(s), 0.0f),
          share_of_first(specular, diffuse)};
}

SurfaceNeeds Phong::needs() const {
  return {.uv = any_needs_uv(options_.diffuse_reflectance, options_.specular_reflectance,
                             options_.exponent)};
}

}  // namespace duet
