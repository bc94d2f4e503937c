// Media, whose coefficients 0.x states in other ways.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"
#include "values/medium_presets.h"
#include "values/text.h"

namespace duet::plugins {

namespace {

PhaseId phase_of(SceneReader& s, Properties& p) {
  const Node* node = p.child(PluginKind::phase);
  const auto phase = node ? s.phase(*node) : std::nullopt;
  return phase ? *phase : s.add_phase({p.node().where, {}, IsotropicPhase{}});
}

Spectrum quotient(const Spectrum& a, const Spectrum& b) {
  Spectrum q;
  for (int c = 0; c < 3; ++c) q[c] = b[c] > 0 ? a[c] / b[c] : 0.0f;
  return q;
}

/// A preset of Mitsuba 0.6. It multiplies the published numbers by 100.
void read_preset(Properties& p, Spectrum& sigma_s, Spectrum& sigma_a, Spectrum& g) {
  const MediumPreset* preset = medium_preset(p);
  if (!preset) return;
  constexpr float kScale = 100;
  sigma_s = preset->sigma_s * kScale;
  sigma_a = preset->sigma_a * kScale;
  g = preset->g;
}

bool has_any(Properties& p, std::string_view a, std::string_view b) {
  return p.has(a) || p.has(b);
}

/// A coefficient that is constant; `otherwise` if the file does not give it.
Spectrum constant_coefficient(SceneReader& s, Properties& p, std::string_view name,
                              const Spectrum& otherwise) {
  if (!p.has(name)) return otherwise;
  const ColorVolume value = s.color_volume(p, name);
  if (const Spectrum* constant = std::get_if<Spectrum>(&value)) return *constant;
  p.error(name, "the parameter \"{}\" of {} cannot be a grid", name, describe(p.node()));
  return otherwise;
}

/// Mitsuba 0.x: a medium that samples distances by one colour channel may be given the coefficients
/// of this channel in all of them.
void make_monochromatic(Properties& p, Spectrum& sigma_s, Spectrum& sigma_a) {
  enum class Strategy { single, other };
  const Strategy strategy = p.choice<Strategy>("strategy", {{"balance", Strategy::other},
                                                            {"single", Strategy::single},
                                                            {"maximum", Strategy::other},
                                                            {"manual", Strategy::other}});
  int channel = 0;
  for (const int c : {1, 2})
    if (sigma_s[c] + sigma_a[c] < sigma_s[channel] + sigma_a[channel]) channel = c;
  if (p.has("channel")) channel = p.integer("channel");
  if (channel < 0 || channel > 2) {
    p.error("channel", "a colour channel is 0, 1 or 2, not {}", channel);
    return;
  }
  if (!p.boolean("monochromatic") || strategy != Strategy::single) return;
  sigma_s = Spectrum(sigma_s[channel]);
  sigma_a = Spectrum(sigma_a[channel]);
}

/// Mitsuba 0.x: coefficients in pairs, or a material's.
void read_coefficients(SceneReader& s, Properties& p, MediumDescription& out) {
  const bool pair = has_any(p, "sigma_s", "sigma_a"), other_pair = has_any(p, "sigma_t", "albedo");
  if (pair && other_pair)
    p.error(p.has("sigma_a") ? "sigma_a" : "sigma_s",
            "either \"sigmaS\" and \"sigmaA\" or \"sigmaT\" and \"albedo\" can be given");
  if ((pair || other_pair) && p.has("material"))
    p.error("material", "either a material or coefficients can be given");
  Spectrum sigma_s, sigma_a, g;
  read_preset(p, sigma_s, sigma_a, g);
  if (pair) {
    sigma_s = constant_coefficient(s, p, "sigma_s", sigma_s);
    sigma_a = constant_coefficient(s, p, "sigma_a", sigma_a);
  } else if (other_pair) {
    const Spectrum sum = sigma_s + sigma_a;
    const Spectrum sigma_t = constant_coefficient(s, p, "sigma_t", sum);
    sigma_s = sigma_t * constant_coefficient(s, p, "albedo", quotient(sigma_s, sum));
    sigma_a = sigma_t - sigma_s;
  }
  g = constant_coefficient(s, p, "g", g);
  if (!(g.max() < 1)) p.error("g", "the anisotropy must be less than 1");
  // Anisotropy is not modelled here, only that light which goes straight on is not scattered.
  sigma_s *= Spectrum(1) - g;
  make_monochromatic(p, sigma_s, sigma_a);
  const Spectrum sigma_t = sigma_s + sigma_a;
  out.sigma_t = sigma_t;
  out.albedo = quotient(sigma_s, sigma_t);
}

/// In Mitsuba 3 a constant extinction fills a box as a grid does: the unit cube, as the "to_world"
/// of its <volume> places it. It becomes a grid of one cell.
VolumeId extinction_box(SceneReader& s, Properties& p, const Spectrum& value) {
  VolumeDescription v;
  v.where = p.node().where;
  v.filter = VolumeFilter::nearest;
  const Property* property = p.has("sigma_t") ? p.find("sigma_t") : nullptr;
  const Node* const* node = property ? std::get_if<const Node*>(&property->value) : nullptr;
  if (node && (*node)->plugin && (*node)->plugin->name == "constvolume")
    v.to_world = Properties(**node, s.report()).transform("to_world");
  auto grid = std::make_shared<VolumeGrid>();
  grid->values = {value.r};
  if (value.g != value.r || value.b != value.r) {
    grid->channels = 3;
    grid->values = {value.r, value.g, value.b};
  }
  v.grid = std::move(grid);
  return s.add_volume(std::move(v));
}

bool is_coloured(SceneReader& s, const ColorVolume& extinction) {
  if (const Spectrum* c = std::get_if<Spectrum>(&extinction)) return c->g != c->r || c->b != c->r;
  const auto& grid = s.description().volumes[size_t(std::get<VolumeId>(extinction))].grid;
  return grid && grid->channels > 1;
}

/// How Mitsuba 3 samples light and distances, where that changes what it renders.
void note_sampling(SceneReader& s, Properties& p, const MediumDescription& medium) {
  if (p.is_0x()) return;
  if (!p.boolean("sample_emitters"))
    s.approximate_loudly(p.where("sample_emitters"),
                         "light that no ray can hit (of point, spot, directional and projecting "
                         "lights) is scattered by the medium, too, which Mitsuba 3 leaves out if "
                         "\"sample_emitters\" is false");
  if (!p.boolean("has_spectral_extinction") && is_coloured(s, medium.sigma_t))
    s.approximate_loudly(p.where("has_spectral_extinction"),
                         "every colour has its own extinction, although "
                         "\"has_spectral_extinction\" is false");
}

void read_homogeneous(SceneReader& s, Properties& p, MediumDescription& out) {
  out.scale = p.number("scale");
  // Files that use the coefficients of 0.x mean them, whatever their version says.
  if (p.is_0x() || has_any(p, "sigma_s", "sigma_a") || has_any(p, "material", "g") ||
      p.boolean("monochromatic")) {
    read_coefficients(s, p, out);
  } else {
    out.sigma_t = s.color_volume(p, "sigma_t");
    out.albedo = s.color_volume(p, "albedo");
  }
  out.phase = phase_of(s, p);
  note_sampling(s, p, out);
}

void read_heterogeneous(SceneReader& s, Properties& p, MediumDescription& out) {
  out.scale = p.number("scale");
  const bool density = p.has("density");
  p.only_one("density", "sigma_t", "sigma_t");
  if (p.is_0x() && !density && !p.has("sigma_t")) p.needs("the parameter \"density\"");
  if (p.is_0x() && !p.has("albedo")) p.needs("the parameter \"albedo\"");
  out.sigma_t = s.color_volume(p, density ? "density" : "sigma_t");
  const Spectrum* constant = std::get_if<Spectrum>(&out.sigma_t);
  if (constant && !p.is_0x()) out.sigma_t = extinction_box(s, p, *constant);
  out.albedo = s.color_volume(p, "albedo");
  if (p.has("orientation")) s.color_volume(p, "orientation");
  out.phase = phase_of(s, p);
  note_sampling(s, p, out);
}

constexpr Parameter kHomogeneous0x[] = {
    {"sigma_a", coefficient, "(of the material)",
     "absorption; with sigma_s instead of sigma_t and albedo", any, v0},
    {"sigma_s", coefficient, "(of the material)", "scattering", any, v0},
    {"material", string, "skin1", "coefficients by the name of a material", any, v0},
    {"g", coefficient, "(of the material)", "scattering counts 1 - g times", any, v0}};
constexpr Parameter kSampling[] = {
    {"sample_emitters", boolean, "true",
     "false: no effect on lights that rays can hit; Mitsuba 3 scatters no light of others then",
     any, v3, approximated},
    {"has_spectral_extinction", boolean, "true",
     "false: no effect on grey extinction; in Mitsuba 3 all then get the mean of the colours' "
     "transmittances",
     any, v3, approximated}};
constexpr Parameter kMonochromatic[] = {
    {"strategy", string, "balance",
     "balance, single, maximum or manual; matters to monochromatic only", any, v0},
    {"channel", integer, "(of least extinction)", "0 to 2; matters to monochromatic only", any, v0},
    {"monochromatic", boolean, "false",
     "with strategy single: all channels are like the one chosen", any, v0}};
constexpr Parameter kDensity{"density", coefficient, "", "the same in 0.x", any, v0};
constexpr Parameter kOrientation{"orientation",
                                 coefficient,
                                 "",
                                 "has no effect: phase functions that need it are approximated",
                                 any,
                                 v0,
                                 approximated};

Parameter of_material(std::string_view name) {
  Parameter p = parameter<MediumDescription>(name);
  p.preset_0x = "(of the material)";
  return p;
}

}  // namespace

const MediumPreset* medium_preset(Properties& p) {
  const std::string name = p.string("material");
  const MediumPreset* preset = find_medium_preset(name);
  if (!preset)
    p.error("material", "no medium is known by the name {}{}", in_quotes(name),
            did_you_mean(to_lower(name), medium_preset_names()));
  return preset;
}

std::vector<Plugin> media() {
  const auto of_medium = [](std::string_view name) { return parameter<MediumDescription>(name); };
  return {
      {"homogeneous",
       both,
       {of_material("sigma_t"), of_material("albedo"), kHomogeneous0x, of_medium("scale"),
        kSampling, kMonochromatic,
        inert_parameters(number, "sampling_density medium_sampling_weight", v0)},
       &read_homogeneous},
      {"heterogeneous",
       both,
       {of_medium("sigma_t"), kDensity, of_medium("albedo"), kOrientation, of_medium("scale"),
        kSampling, inert_parameters(string, "method", v0),
        inert_parameters(number, "step_size", v0)},
       &read_heterogeneous},
  };
}

std::vector<Plugin> subsurfaces() {
  constexpr const char* why =
      "light leaves a surface where it entered: use an interior medium with volpath";
  return {refused_plugin(
              "dipole", v0, why,
              "material sigma_s sigma_a sigma_t albedo int_ior ext_ior scale irr_samples quality"),
          refused_plugin("singlescatter", v0, why,
                         "fast_single_scatter fast_single_scatter_samples "
                         "single_scatter_shadow_rays single_scatter_transmittance "
                         "single_scatter_depth")};
}

}  // namespace duet::plugins
