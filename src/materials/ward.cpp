#include "materials/ward.h"

#include "materials/fresnel.h"
#include "materials/materials.h"
#include "math/warp.h"

namespace duet {

ModelEval WardModel::eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
  if (!(wo.z > kMinCosine && wi.z > kMinCosine)) return {};
  const float diffuse_pdf = wi.z * kInvPi;
  ModelEval e{diffuse * diffuse_pdf, (1 - specular_probability) * diffuse_pdf};
  const Vector3f h = wo + wi;
  const float z2 = h.z * h.z, h2 = length_squared(h);
  const float lobe =
      std::exp(-(sqr(h.x / alpha_u) + sqr(h.y / alpha_v)) / z2) * kInvPi / (alpha_u * alpha_v);
  float norm = 0;
  switch (variant) {
    case WardVariant::ward:
      norm = 0.25f / std::sqrt(wo.z * wi.z);
      break;
    case WardVariant::duer:
      norm = 0.25f / (wo.z * wi.z);
      break;
    case WardVariant::balanced:
      norm = h2 / (z2 * z2);
      break;
  }
  e.value += specular * (lobe * norm * wi.z);
  // Half vectors have the density lobe / cos³θh; of directions it is that over 4 (h·wi).
  const float length = std::sqrt(h2), cosine = h.z / length;
  e.pdf += specular_probability * lobe * length / (4 * dot(h, wi) * cosine * cosine * cosine);
  return e;
}

std::optional<ModelSample> WardModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                             Transport transport) const {
  if (!(wo.z > kMinCosine)) return std::nullopt;
  Vector3f wi;
  if (u < specular_probability) {
    // The half vector's slope (x / αu, y / αv) is normally distributed.
    const float r = std::sqrt(-std::log(1 - v.y));
    float sine, cosine;
    sincos_turns(v.x, sine, cosine);
    wi = reflect(wo, normalize(Vector3f(alpha_u * r * cosine, alpha_v * r * sine, 1)));
  } else {
    wi = square_to_cosine_hemisphere(v);
  }
  return sample_from(eval(wo, wi, transport), wi);
}

Ward::Ward(const WardOptions& options) : options_(options) {
  if (all_constant(options.diffuse_reflectance, options.specular_reflectance, options.alpha_u,
                   options.alpha_v))
    set_constant(model({}));
}

WardModel Ward::model(const Surface& s) const {
  const Spectrum diffuse = options_.diffuse_reflectance(s);
  const Spectrum specular = options_.specular_reflectance(s);
  return {diffuse,
          specular,
          std::max(options_.alpha_u(s), Microfacet::kMinAlpha),
          std::max(options_.alpha_v(s), Microfacet::kMinAlpha),
          share_of_first(specular, diffuse),
          options_.variant};
}

SurfaceNeeds Ward::needs() const {
  return {.uv = any_needs_uv(options_.diffuse_reflectance, options_.specular_reflectance,
                             options_.alpha_u, options_.alpha_v),
          .tangents = true};
}

}  // namespace duet
