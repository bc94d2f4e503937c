// Materials that are not made of others.
#include "mitsuba/ior.h"
#include "mitsuba/read_roughness.h"
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "mitsuba/text.h"
#include "mitsuba/two_lobes.h"

namespace duet {

namespace {

bool is_rough(const Properties& p) {
  return p.node().type.starts_with("rough");
}

Roughness roughness(SceneReader& s, Properties& p) {
  Roughness r;
  enum class Name { beckmann, ggx, phong };
  const Name name = p.choice<Name>("distribution", {{"beckmann", Name::beckmann},
                                                    {"ggx", Name::ggx},
                                                    {"phong", Name::phong},
                                                    {"as", Name::phong}});
  r.distribution =
      name == Name::ggx ? MicrofacetDistribution::ggx : MicrofacetDistribution::beckmann;
  if (name == Name::phong)
    s.approximate_loudly(p.where("distribution"),
                         "the Phong microfacet distribution is approximated by Beckmann's");
  r.sample_visible = p.boolean("sample_visible");

  r.alpha_u = r.alpha_v = s.number_or_texture(p, "alpha");
  // Plastic is isotropic.
  if (!find_parameter(PluginKind::bsdf, *p.node().plugin, "alpha_u")) return r;
  const bool u = p.has("alpha_u"), v = p.has("alpha_v");
  if (u != v)
    p.error(u ? "alpha_u" : "alpha_v", "\"alpha_u\" and \"alpha_v\" must be given together");
  if (!u || !v) return r;
  if (p.has("alpha"))
    p.error("alpha_u", "either \"alpha\" or \"alpha_u\" and \"alpha_v\" can be given");
  r.alpha_u = s.number_or_texture(p, "alpha_u");
  r.alpha_v = s.number_or_texture(p, "alpha_v");
  return r;
}

/// A roughness of zero or less has no distribution; Mitsuba uses a small one then.
void check_alpha(Properties& p, Roughness& r) {
  constexpr double least = 1e-4;
  for (FloatInput* alpha : {&r.alpha_u, &r.alpha_v})
    if (double* value = std::get_if<double>(alpha)) {
      if (*value < 0)
        p.error(p.has("alpha") ? "alpha" : "alpha_u", "a roughness must not be negative");
      *value = std::max(*value, least);
    }
}

std::optional<Roughness> optional_roughness(SceneReader& s, Properties& p) {
  return is_rough(p) ? std::optional(checked_roughness(s, p)) : std::nullopt;
}

}  // namespace

Roughness checked_roughness(SceneReader& s, Properties& p) {
  Roughness r = roughness(s, p);
  check_alpha(p, r);
  return r;
}

double relative_index(SceneReader& s, Properties& p) {
  const double inside = s.index_of_refraction(p, "int_ior");
  const double outside = s.index_of_refraction(p, "ext_ior");
  if (is_rough(p) && inside == outside)
    p.error("int_ior", "the indices of refraction of {} must differ", describe(p.node()));
  return inside / outside;
}

namespace {

void divide(ColorInput& color, double divisor) {
  if (Spectrum* constant = std::get_if<Spectrum>(&color))
    *constant = {float(double(constant->r) / divisor), float(double(constant->g) / divisor),
                 float(double(constant->b) / divisor)};
}

}  // namespace

void read_diffuse(SceneReader& s, Properties& p, MaterialDescription& out) {
  out.model = DiffuseMaterial{s.color(p, "reflectance")};
}

void read_conductor(SceneReader& s, Properties& p, MaterialDescription& out) {
  ConductorMaterial m;
  const bool has_index = p.has("eta") || p.has("k");
  if (p.has("material") && has_index && !p.is_0x())
    p.error("material", "either \"material\" or \"eta\" and \"k\" can be given");
  const std::string name =
      p.has("material") || p.is_0x() || !has_index ? p.string("material") : "none";
  bool mirror = to_lower(name) == "none";
  if (const ConductorEntry* entry = find_conductor(name)) {
    m.eta = entry->eta;
    m.k = entry->k;
  } else if (!mirror) {
    p.error("material", "no metal is called {}{}", in_quotes(name),
            did_you_mean(name, conductor_names()));
  }
  if (p.has("eta")) m.eta = s.color(p, "eta"), mirror = false;
  if (p.has("k")) m.k = s.color(p, "k"), mirror = false;
  const double outside = p.is_0x() || p.has("ext_eta") ? s.index_of_refraction(p, "ext_eta") : 1.0;
  if (!mirror) divide(m.eta, outside), divide(m.k, outside);
  m.specular_reflectance = s.color(p, "specular_reflectance");
  m.roughness = optional_roughness(s, p);
  out.model = m;
}

void read_dielectric(SceneReader& s, Properties& p, MaterialDescription& out) {
  DielectricMaterial m;
  m.eta = relative_index(s, p);
  m.specular_reflectance = s.color(p, "specular_reflectance");
  m.specular_transmittance = s.color(p, "specular_transmittance");
  m.roughness = optional_roughness(s, p);
  out.model = m;
}

void read_thindielectric(SceneReader& s, Properties& p, MaterialDescription& out) {
  out.model = ThinDielectricMaterial{relative_index(s, p), s.color(p, "specular_reflectance"),
                                     s.color(p, "specular_transmittance")};
}

void read_plastic(SceneReader& s, Properties& p, MaterialDescription& out) {
  PlasticMaterial m;
  m.eta = relative_index(s, p);
  m.diffuse_reflectance = s.color(p, "diffuse_reflectance");
  m.specular_reflectance = s.color(p, "specular_reflectance");
  m.nonlinear = p.boolean("nonlinear");
  m.roughness = optional_roughness(s, p);
  out.model = m;
}

void read_principled(SceneReader& s, Properties& p, MaterialDescription& out) {
  PrincipledMaterial m;
  m.base_color = s.color(p, "base_color");
  const auto read = [&](std::string_view name) { return s.number_or_texture(p, name); };
  m.roughness = read("roughness");
  m.anisotropic = read("anisotropic");
  m.metallic = read("metallic");
  m.spec_trans = read("spec_trans");
  if (p.has("eta") && p.has("specular"))
    p.error("eta", "either \"eta\" or \"specular\" can be given");
  m.eta = p.optional_number("eta").value_or(m.eta);
  m.specular = p.optional_number("specular");
  m.spec_tint = read("spec_tint");
  m.sheen = read("sheen");
  m.sheen_tint = read("sheen_tint");
  m.flatness = read("flatness");
  m.clearcoat = read("clearcoat");
  m.clearcoat_gloss = read("clearcoat_gloss");
  m.diffuse_reflectance_sampling_rate = p.number("diffuse_reflectance_sampling_rate");
  m.main_specular_sampling_rate = p.number("main_specular_sampling_rate");
  m.clearcoat_sampling_rate = p.number("clearcoat_sampling_rate");
  out.model = m;
}

void read_principledthin(SceneReader& s, Properties& p, MaterialDescription& out) {
  PrincipledThinMaterial m;
  m.base_color = s.color(p, "base_color");
  const auto read = [&](std::string_view name) { return s.number_or_texture(p, name); };
  m.roughness = read("roughness");
  m.anisotropic = read("anisotropic");
  m.spec_trans = read("spec_trans");
  m.eta = read("eta");
  m.spec_tint = read("spec_tint");
  m.sheen = read("sheen");
  m.sheen_tint = read("sheen_tint");
  m.flatness = read("flatness");
  m.diff_trans = read("diff_trans");
  m.spec_reflectance_sampling_rate = p.number("specular_reflectance_sampling_rate");
  m.spec_transmittance_sampling_rate = p.number("specular_transmittance_sampling_rate");
  m.diffuse_reflectance_sampling_rate = p.number("diffuse_reflectance_sampling_rate");
  m.diffuse_transmittance_sampling_rate = p.number("diffuse_transmittance_sampling_rate");
  out.model = m;
}

void conserve_energy(SceneReader& s, Properties& p, ColorInput& diffuse, ColorInput& specular) {
  Spectrum* const a = std::get_if<Spectrum>(&diffuse);
  Spectrum* const b = std::get_if<Spectrum>(&specular);
  if (!a || !b) return;
  const float sum = (*a + *b).max();
  if (!(sum > 1)) return;
  const float scale = 0.99f / sum;
  *a *= scale, *b *= scale;
  s.report().warning(p.node().where,
                     "{} would reflect {:.3g} times the light that meets it: both of its lobes are "
                     "scaled by {:.3g}",
                     describe(p.node()), sum, scale);
}

void read_phong(SceneReader& s, Properties& p, MaterialDescription& out) {
  PhongMaterial m;
  m.exponent = s.number_or_texture(p, "exponent");
  m.diffuse_reflectance = s.color(p, "diffuse_reflectance");
  m.specular_reflectance = s.color(p, "specular_reflectance");
  if (const double* exponent = std::get_if<double>(&m.exponent); exponent && *exponent < 0)
    p.error("exponent", "an exponent must not be negative");
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
  out.model = m;
}

void read_ward(SceneReader& s, Properties& p, MaterialDescription& out) {
  WardMaterial m;
  m.variant = p.choice<WardVariant>("variant", {{"ward", WardVariant::ward},
                                                {"ward-duer", WardVariant::duer},
                                                {"balanced", WardVariant::balanced}});
  m.diffuse_reflectance = s.color(p, "diffuse_reflectance");
  m.specular_reflectance = s.color(p, "specular_reflectance");
  m.alpha_u = s.number_or_texture(p, "alpha_u");
  m.alpha_v = s.number_or_texture(p, "alpha_v");
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
  out.model = m;
}

void read_roughdiffuse(SceneReader& s, Properties& p, MaterialDescription& out) {
  RoughDiffuseMaterial m;
  m.reflectance = s.color(p, "reflectance");
  m.alpha = s.number_or_texture(p, "alpha");
  m.use_fast_approx = p.boolean("use_fast_approx");
  out.model = m;
}

void read_difftrans(SceneReader& s, Properties& p, MaterialDescription& out) {
  out.model = DiffuseTransmitterMaterial{s.color(p, "transmittance")};
}

void read_null(SceneReader&, Properties&, MaterialDescription& out) {
  out.model = NullMaterial{};
}

}  // namespace duet
