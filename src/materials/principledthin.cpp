#include "materials/principledthin.h"

#include "materials/principled_materials.h"

namespace duet {

namespace {

/// As in Mitsuba, transmitted light has to meet the facet h from the side from which it meets the
/// surface, seen with the eye above. `o` lies above the surface and `i` below.
bool meets_facet(const Vector3f& o, const Vector3f& i, const Vector3f& h, Transport transport) {
  return transport == Transport::radiance ? dot(i, h) < 0 : dot(mirrored(o, true), h) < 0;
}

}  // namespace

ModelEval PrincipledThinModel::eval_reflection(const Vector3f& o, const Vector3f& i) const {
  const Vector3f h = normalize(o + i);
  const float cosine = dot(o, h);
  ModelEval e;
  e.pdf = pick_diffuse * i.z * kInvPi;
  if (spec_trans > 0) {
    Spectrum f(fresnel_dielectric(cosine, eta).reflectance);
    if (spec_tint > 0) {
      const Spectrum tinted =
          lerp(tint * normal_reflectance(eta), Spectrum(1), schlick_weight(cosine, eta));
      f = lerp(f, tinted, spec_tint);
    }
    const Microfacet::Core core = facets.core(o, i, h);
    e.value += f * (spec_trans * 0.25f * core.value);
    e.pdf += pick_reflection * 0.25f * core.density;
  }
  const float diffuse = (1 - spec_trans) * (1 - diff_trans) * i.z;
  if (diffuse > 0) {
    e.value +=
        base_color * (diffuse * kInvPi * principled_diffuse(o.z, i.z, cosine, roughness, flatness));
    if (sheen > 0)
      e.value += lerp(Spectrum(1), tint, sheen_tint) * (diffuse * sheen * schlick_weight(cosine));
  }
  return e;
}

/// Specular transmission is reflection that is then mirrored to the other side.
ModelEval PrincipledThinModel::eval_transmission(const Vector3f& o, const Vector3f& i,
                                                 Transport transport) const {
  ModelEval e;
  e.value = base_color * ((1 - spec_trans) * diff_trans * kInvPi * -i.z);
  e.pdf = pick_diffuse_transmission * kInvPi * -i.z;
  if (spec_trans > 0) {
    const Vector3f r = mirrored(i, true);
    const Vector3f h = normalize(o + r);
    if (meets_facet(o, i, h, transport)) {
      const Microfacet::Core core = transmission_facets.core(o, r, h);
      const float f = fresnel_dielectric(dot(o, h), eta).reflectance;
      e.value += base_color * (spec_trans * (1 - f) * 0.25f * core.value);
      e.pdf += pick_transmission * 0.25f * core.density;
    }
  }
  return e;
}

ModelEval PrincipledThinModel::eval(const Vector3f& wo, const Vector3f& wi,
                                    Transport transport) const {
  if (std::abs(wo.z) < kMinCosine || std::abs(wi.z) < kMinCosine) return {};
  const bool below = wo.z < 0;
  const Vector3f o = mirrored(wo, below), i = mirrored(wi, below);
  return i.z > 0 ? eval_reflection(o, i) : eval_transmission(o, i, transport);
}

std::optional<ModelSample> PrincipledThinModel::sample(const Vector3f& wo, float u,
                                                       const Point2f& v,
                                                       Transport transport) const {
  if (std::abs(wo.z) < kMinCosine) return std::nullopt;
  const bool below = wo.z < 0;
  const Vector3f o = mirrored(wo, below);
  Vector3f i;
  const float specular = pick_reflection + pick_transmission;
  if (u < specular) {
    const bool reflects = u < pick_reflection;
    const Vector3f r = reflect(o, (reflects ? facets : transmission_facets).sample(o, v));
    if (!(r.z > 0)) return std::nullopt;
    i = mirrored(r, !reflects);
    if (!reflects && !meets_facet(o, i, o + r, transport)) return std::nullopt;
  } else {
    i = mirrored(square_to_cosine_hemisphere(v), u >= specular + pick_diffuse);
  }
  const Vector3f wi = mirrored(i, below);
  const ModelEval e = eval(wo, wi, transport);
  if (!(e.pdf > 0)) return std::nullopt;
  return ModelSample{.wi = wi, .weight = e.value / e.pdf, .pdf = e.pdf};
}

PrincipledThin::PrincipledThin(const PrincipledThinOptions& options) : options_(options) {
  const PrincipledThinOptions& o = options_;
  if (all_constant(o.base_color, o.roughness, o.anisotropic, o.spec_trans, o.eta, o.spec_tint,
                   o.sheen, o.sheen_tint, o.flatness, o.diff_trans))
    set_constant(model({}));
}

PrincipledThinModel PrincipledThin::model(const Surface& s) const {
  const PrincipledThinOptions& o = options_;
  PrincipledThinModel m;
  m.base_color = o.base_color(s);
  m.tint = tint_of(m.base_color);
  m.roughness = std::max(o.roughness(s), 0.0f);
  m.spec_trans = clamped_to_unit(o.spec_trans(s));
  m.eta = std::clamp(o.eta(s), 1e-2f, 1e2f);
  const float anisotropic = clamped_to_unit(o.anisotropic(s));
  m.facets = principled_facets(m.roughness, anisotropic);
  // Burley 2015, figure 15: what is refracted twice is spread according to the index.
  m.transmission_facets = principled_facets((0.65f * m.eta - 0.35f) * m.roughness, anisotropic);
  m.spec_tint = clamped_to_unit(o.spec_tint(s));
  m.sheen = std::max(o.sheen(s), 0.0f);
  m.sheen_tint = clamped_to_unit(o.sheen_tint(s));
  m.flatness = clamped_to_unit(o.flatness(s));
  m.diff_trans = 0.5f * std::clamp(o.diff_trans(s), 0.0f, 2.0f);
  const float reflection = 0.5f * m.spec_trans * o.spec_reflectance_sampling_rate;
  const float transmission = 0.5f * m.spec_trans * o.spec_transmittance_sampling_rate;
  const float diffuse =
      (1 - m.spec_trans) * (1 - m.diff_trans) * o.diffuse_reflectance_sampling_rate;
  const float diffuse_transmission =
      (1 - m.spec_trans) * m.diff_trans * o.diffuse_transmittance_sampling_rate;
  const float sum = reflection + transmission + diffuse + diffuse_transmission;
  const float scale = sum > 0 ? 1 / sum : 0.0f;
  m.pick_reflection = reflection * scale;
  m.pick_transmission = transmission * scale;
  m.pick_diffuse = diffuse * scale;
  m.pick_diffuse_transmission = diffuse_transmission * scale;
  return m;
}

SurfaceNeeds PrincipledThin::needs() const {
  const PrincipledThinOptions& o = options_;
  return {.uv = any_needs_uv(o.base_color, o.roughness, o.anisotropic, o.spec_trans, o.eta,
                             o.spec_tint, o.sheen, o.sheen_tint, o.flatness, o.diff_trans),
          .tangents = is_used(o.anisotropic)};
}

bool PrincipledThin::transmits() const {
  return is_used(options_.spec_trans) || is_used(options_.diff_trans);
}

}  // namespace duet
