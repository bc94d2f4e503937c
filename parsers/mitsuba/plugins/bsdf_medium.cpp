// BSDFs by the coefficients of a medium.
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"
#include "mitsuba/plugins/tables.h"
#include "values/dipole.h"
#include "values/medium_presets.h"

namespace duet::plugins {

namespace {

struct Coefficients {
  ColorInput sigma_s, sigma_a;
};

/// Mitsuba 0.6: coefficients in pairs, or a material's. A texture counts only in the first pair.
Coefficients read_coefficients(SceneReader& s, Properties& p) {
  const bool pair = p.has("sigma_s") || p.has("sigma_a");
  const bool other = p.has("sigma_t") || p.has("albedo");
  if (pair + other + p.has("material") > 1)
    p.error(pair ? (p.has("sigma_s") ? "sigma_s" : "sigma_a") : "material",
            "only one of a material, \"sigma_s\" with \"sigma_a\", and \"sigma_t\" with \"albedo\" "
            "can be given");
  const MediumPreset* preset = medium_preset(p);
  if (!preset) return {Spectrum(1), Spectrum(0)};
  Coefficients c{preset->sigma_s, preset->sigma_a};
  if (pair) {
    if (p.has("sigma_s")) c.sigma_s = s.color(p, "sigma_s");
    if (p.has("sigma_a")) c.sigma_a = s.color(p, "sigma_a");
  } else if (other) {
    const Spectrum sum = preset->sigma_s + preset->sigma_a;
    const Spectrum sigma_t = p.has("sigma_t") ? s.constant_color(p, "sigma_t") : sum;
    Spectrum albedo = p.has("albedo") ? s.constant_color(p, "albedo") : Spectrum(0.5f);
    if (!p.has("albedo"))
      for (int i = 0; i < 3; ++i) albedo[i] = sum[i] > 0 ? preset->sigma_s[i] / sum[i] : 0.0f;
    c.sigma_s = sigma_t * albedo;
    c.sigma_a = sigma_t * (Spectrum(1) - albedo);
  }
  return c;
}

void read_hk(SceneReader& s, Properties& p, MaterialDescription& out) {
  ThinLayerMaterial m;
  const Coefficients c = read_coefficients(s, p);
  m.sigma_s = c.sigma_s, m.sigma_a = c.sigma_a;
  read_values(s, p, m);
  if (const Node* node = p.child(PluginKind::phase)) {
    const auto id = s.phase(*node);
    const PhaseDescription* phase = id ? &s.description().phases[size_t(*id)] : nullptr;
    if (const auto* hg = phase ? std::get_if<HenyeyGreensteinPhase>(&phase->model) : nullptr)
      m.g = hg->g;
    else if (phase && !std::holds_alternative<IsotropicPhase>(phase->model))
      s.approximate_loudly(node->where, "the phase function of \"hk\" is isotropic");
  }
  out.model = m;
}

void read_sssbrdf(SceneReader& s, Properties& p, MaterialDescription& out) {
  s.approximate_loudly(p.node().where,
                       "\"sssbrdf\" is a rough plastic whose base reflects what a dipole of its "
                       "coefficients does");
  PlasticMaterial m;
  m.eta = relative_index(s, p);
  m.nonlinear = true;
  m.roughness = read_roughness(s, p);
  const Coefficients c = read_coefficients(s, p);
  const Spectrum* sigma_s = std::get_if<Spectrum>(&c.sigma_s);
  const Spectrum* sigma_a = std::get_if<Spectrum>(&c.sigma_a);
  if (!sigma_s || !sigma_a)
    return p.error("sigma_s", "the coefficients of \"sssbrdf\" cannot be textures");
  const double g = double(float(p.number("g")));
  Spectrum base;
  for (int i = 0; i < 3; ++i)
    base[i] =
        float(base_like_dipole(double((*sigma_s)[i]) * (1 - g), double((*sigma_a)[i]), m.eta));
  m.diffuse_reflectance = base;
  out.model = m;
}

constexpr Parameter kMediumName{"material", string, "skin1", "name of a medium"};
constexpr Parameter kExtinction{"sigma_t", unbounded, "", "extinction coefficient"};
constexpr Parameter kAlbedo{"albedo", reflectance, "", "share that is scattered"};
constexpr Parameter kMeanCosine{"g", number, "0", "mean cosine of scattering"};

ParameterList coefficients() {
  return {kMediumName, parameters_of<ThinLayerMaterial>("sigma_s sigma_a"), kExtinction, kAlbedo};
}

}  // namespace

Plugin hk() {
  return {.name = "hk",
          .parameters = {coefficients(), parameter<ThinLayerMaterial>("thickness")},
          .reader = &read_hk,
          .note = "may hold a phase function: isotropic or hg; Mitsuba 3 has none"};
}

Plugin sssbrdf() {
  return {.name = "sssbrdf",
          .parameters = {coefficients(), parameters_of<DielectricMaterial>("int_ior ext_ior"),
                         kMeanCosine, kDistribution, kAlpha, kSampleVisible},
          .reader = &read_sssbrdf,
          .note = "a rough plastic with the reflectance of a dipole; Mitsuba 3 has none",
          .support = approximated};
}

}  // namespace duet::plugins
