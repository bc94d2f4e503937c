#include "materials/principled.h"

#include "materials/principled_materials.h"

namespace duet {

namespace {

/// Smith's masking for the clear coat, whose roughness Burley fixes at 0.25 for this purpose.
float clearcoat_masking(float cosine) {
  return 2 * cosine / (cosine + std::sqrt(cosine * cosine + sqr(0.25f) * (1 - cosine * cosine)));
}

}  // namespace

Microfacet principled_facets(float roughness, float anisotropic) {
  const float aspect = std::sqrt(1 - 0.9f * anisotropic), alpha = roughness * roughness;
  return {MicrofacetDistribution::ggx, std::max(alpha / aspect, 1e-3f),
          std::max(alpha * aspect, 1e-3f), true};
}

float PrincipledModel::nearly_specular_share() const {
  const bool sharp = facets.is_nearly_specular(),
             sharp_coat = clearcoat_alpha2 < float(sqr(kNearlySpecular));
  if (!(sharp || (sharp_coat && clearcoat > 0))) return 0;
  // What the lobes scatter of light along the normal.
  const float f = normal_reflectance(eta);
  const float specular = metallic + bsdf() + brdf() * f;
  const float coat = 0.25f * clearcoat * normal_reflectance(1.5f);
  const float diffuse = brdf() * (1 - f) * base_color.luminance();
  const float all = specular + coat + diffuse;
  return all > 0 ? ((sharp ? specular : 0.0f) + (sharp_coat ? coat : 0.0f)) / all : 0.0f;
}

PrincipledModel::Choice PrincipledModel::choice() const {
  Choice c{brdf() * diffuse_rate, 0.25f * clearcoat * clearcoat_rate, specular_rate};
  const float sum = c.diffuse + c.clearcoat + c.specular;
  if (!(sum > 0)) return {0, 0, 0};
  return {c.diffuse / sum, c.clearcoat / sum, c.specular / sum};
}

/// Reflection seen from above.
ModelEval PrincipledModel::eval_front(const Vector3f& o, const Vector3f& i) const {
  const Microfacet::Reflection r = facets.visible_ggx_reflection(o, i);
  const Choice pick = choice();
  ModelEval e = eval_uncoated(o, i, r, pick);
  if (clearcoat > 0) {
    const float h = (o.z + i.z) / (2 * r.cosine);  // the half vector's cosine
    const float d = clearcoat_density(h);
    const float fc = lerp(0.04f, 1.0f, schlick_weight(r.cosine, eta));
    e.value += Spectrum(0.25f * clearcoat * fc * d * clearcoat_masking(o.z) *
                        clearcoat_masking(i.z) * i.z);
    e.pdf += pick.clearcoat * d * h / (4 * r.cosine);
  }
  return e;
}

ModelEval PrincipledModel::eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const {
  if (std::abs(wo.z) < kMinCosine || std::abs(wi.z) < kMinCosine) return {};
  const bool below = wo.z<0, reflects = wo.z * wi.z> 0;
  if ((below || !reflects) && !(bsdf() > 0)) return {};
  // The side that light comes from is up.
  const Vector3f o = mirrored(wo, below), i = mirrored(wi, below);
  if (reflects && !below) return eval_front(o, i);
  const float relative = below ? 1 / eta : eta;
  Vector3f h = reflects ? o + i : o + i * relative;
  h = normalize(h.z < 0 ? -h : h);
  const float oh = dot(o, h), ih = dot(i, h);
  if (!(h.z > 0 && oh > 0 && (reflects ? ih > 0 : ih < 0))) return {};
  const Microfacet::Core core = facets.core(o, i, h);
  const float f = fresnel_dielectric(oh, relative).reflectance;
  if (reflects) return {Spectrum(bsdf() * f * 0.25f * core.value), f * 0.25f * core.density};
  const float jacobian = sqr(relative / (oh + relative * ih)) * oh * -ih;
  const float compression = transport == Transport::radiance ? 1 / sqr(relative) : 1.0f;
  const float pick = below ? 1.0f : choice().specular * bsdf();
  return {sqrt(base_color) * (bsdf() * (1 - f) * core.value * jacobian * compression),
          pick * (1 - f) * core.density * jacobian};
}

std::optional<ModelSample> PrincipledModel::sample(const Vector3f& wo, float u, const Point2f& v,
                                                   Transport transport) const {
  const bool below = wo.z < 0;
  if (std::abs(wo.z) < kMinCosine || (below && !(bsdf() > 0))) return std::nullopt;
  const Vector3f o = mirrored(wo, below);
  const float relative = below ? 1 / eta : eta;
  const Choice pick = below ? Choice{0, 0, 1} : choice();
  Vector3f i;
  float side = 1;  // relative index of the far side
  if (u < pick.diffuse) {
    i = square_to_cosine_hemisphere(v);
  } else if (u < pick.diffuse + pick.clearcoat) {
    // GTR1 has sin² θ = (α^(2 − 2x) − α²) / (1 − α²) at the quantile x (Burley 2012, eq. 5).
    const Point2f p = square_to_disk(v);
    const float x = p.x * p.x + p.y * p.y, a2 = clearcoat_alpha2;
    const float log_a2 = (a2 - 1) * kInvPi / clearcoat_scale;
    const float sin2 = a2 * std::expm1(-x * log_a2) / (1 - a2);
    const float scale = x > 0 ? std::sqrt(sin2 / x) : 0.0f;
    i = reflect(o, Vector3f(p.x * scale, p.y * scale, safe_sqrt(1 - sin2)));
    if (!(i.z > 0)) return std::nullopt;
  } else {
    u = pick.specular > 0 ? (u - pick.diffuse - pick.clearcoat) / pick.specular : 1.0f;
    const Vector3f m = facets.sample(o, v);
    const float om = dot(o, m);
    if (!(om > 0)) return std::nullopt;
    const DielectricFresnel f = fresnel_dielectric(om, relative);
    const float transmits = (below ? 1.0f : bsdf()) * (1 - f.reflectance);
    if (u < transmits) {
      i = m * (om / relative - f.cos_t) - o * (1 / relative);
      if (!(i.z < 0)) return std::nullopt;
      side = relative;
    } else {
      i = reflect(o, m);
      if (!(i.z > 0)) return std::nullopt;
    }
  }
  const Vector3f wi = mirrored(i, below);
  const ModelEval e = eval(wo, wi, transport);
  if (!(e.pdf > 0)) return std::nullopt;
  return ModelSample{.wi = wi, .weight = e.value / e.pdf, .pdf = e.pdf, .eta = side};
}

float principled_eta(float specular, bool transmits) {
  // Transmission through an interface without refraction is not a microfacet model.
  if (transmits && specular == 0) specular = 1e-3f;
  return 2 / (1 - std::sqrt(0.08f * specular)) - 1;
}

Principled::Principled(const PrincipledOptions& options) : options_(options) {
  if (is_used(options.spec_trans) && options.eta == 1) options_.eta = 1.001f;
  const PrincipledOptions& o = options_;
  if (all_constant(o.base_color, o.roughness, o.anisotropic, o.metallic, o.spec_trans, o.spec_tint,
                   o.sheen, o.sheen_tint, o.flatness, o.clearcoat, o.clearcoat_gloss))
    set_constant(model({}));
}

PrincipledModel Principled::model(const Surface& s) const {
  PrincipledModel m = without_color(s);
  m.base_color = options_.base_color(s);
  m.tint = tint_of(m.base_color);
  return m;
}

std::optional<PrincipledModel> Principled::uniform_reflection() const {
  const PrincipledOptions& o = options_;
  if (!all_constant(o.roughness, o.metallic, o.spec_tint, o.sheen, o.sheen_tint, o.flatness) ||
      is_used(o.anisotropic) || is_used(o.spec_trans) || is_used(o.clearcoat))
    return std::nullopt;
  return without_color({});
}

PrincipledModel Principled::without_color(const Surface& s) const {
  const PrincipledOptions& o = options_;
  PrincipledModel m;
  m.base_color = m.tint = Spectrum(1);
  m.roughness = std::max(o.roughness(s), 0.0f);
  m.facets = principled_facets(m.roughness, clamped_to_unit(o.anisotropic(s)));
  m.metallic = clamped_to_unit(o.metallic(s));
  m.spec_trans = clamped_to_unit(o.spec_trans(s));
  m.eta = o.eta;
  m.spec_tint = clamped_to_unit(o.spec_tint(s));
  m.sheen = std::max(o.sheen(s), 0.0f);
  m.sheen_tint = clamped_to_unit(o.sheen_tint(s));
  m.flatness = clamped_to_unit(o.flatness(s));
  m.clearcoat = std::max(o.clearcoat(s), 0.0f);
  m.clearcoat_alpha2 = sqr(lerp(0.1f, 0.001f, clamped_to_unit(o.clearcoat_gloss(s))));
  m.clearcoat_scale = (m.clearcoat_alpha2 - 1) * kInvPi / std::log(m.clearcoat_alpha2);
  m.diffuse_rate = o.diffuse_reflectance_sampling_rate;
  m.specular_rate = o.main_specular_sampling_rate;
  m.clearcoat_rate = o.clearcoat_sampling_rate;
  return m;
}

SurfaceNeeds Principled::needs() const {
  const PrincipledOptions& o = options_;
  return {.uv = any_needs_uv(o.base_color, o.roughness, o.anisotropic, o.metallic, o.spec_trans,
                             o.spec_tint, o.sheen, o.sheen_tint, o.flatness, o.clearcoat,
                             o.clearcoat_gloss),
          .tangents = is_used(o.anisotropic)};
}

bool Principled::transmits() const {
  return is_used(options_.spec_trans);
}

}  // namespace duet
