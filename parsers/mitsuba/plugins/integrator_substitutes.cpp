// Integrators of Mitsuba that another method stands in for: said in a warning, each by name.
#include "mitsuba/plugins/integrators.h"

namespace duet::plugins {

void note_substitute(SceneReader& s, const Properties& p, std::string_view method,
                     std::string_view why) {
  s.approximate_loudly(p.node().where,
                       fmt::format("the integrator \"{}\" is run as \"{}\"{}{}",
                                   p.node().plugin->name, method, why.empty() ? "" : ": ", why));
}

namespace {

constexpr std::string_view kNoDerivatives = "images are the same, derivatives are not computed";

template <class T>
void read_without_derivatives(SceneReader& s, Properties& p, IntegratorDescription& out) {
  read_method<T>(s, p, out);
  note_substitute(s, p, std::get<T>(out.method).method_name(), kNoDerivatives);
}

void read_direct_projective(SceneReader& s, Properties& p, IntegratorDescription& out) {
  DirectIntegratorDescription direct;
  direct.hide_emitters = p.boolean("hide_emitters");
  out.method = direct;
  note_substitute(s, p, "direct", kNoDerivatives);
}

void read_metropolis(SceneReader& s, Properties& p, IntegratorDescription& out) {
  read_method<BidirectionalIntegratorDescription>(s, p, out);
  note_substitute(s, p, "bdpt");
}

void read_vpl(SceneReader& s, Properties& p, IntegratorDescription& out) {
  PathIntegratorDescription path;
  path.max_depth = p.integer("max_depth");
  out.method = path;
  note_substitute(s, p, "path");
}

void read_as_nested(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const Node* nested = nested_integrator(p);
  if (!nested || !s.read_into(*nested, out)) return;
  const std::string_view name = p.node().plugin->name;
  note_substitute(s, p, nested->type,
                  name == "irrcache"   ? "irradiance is computed at every point, not cached"
                  : name == "adaptive" ? "every pixel gets the same number of samples"
                                       : "light has no polarisation here, so S1 to S3 are missing");
}

Parameter depth_limit(std::string_view preset) {
  Parameter p = parameter<PathIntegratorDescription>("max_depth");
  p.preset = preset;
  return p;
}

/// Of what stands in for what only 0.x has.
Plugin stand_in_0x(std::string_view name, const ParameterList& parameters,
                   ReadInto<IntegratorDescription> reader, std::string_view note) {
  return {name, v0, parameters, reader, note, approximated};
}

}  // namespace

std::vector<Plugin> substituted_integrators() {
  using Path = PathIntegratorDescription;
  const ParameterList prb(depth_limit("6"), parameters_of<Path>("rr_depth hide_emitters"));
  const ParameterList projective(
      prb, inert_parameters(integer, "sppc sppp sppi"), inert_parameters(string, "guiding"),
      inert_parameters(boolean, "guiding_proj"), inert_parameters(integer, "guiding_rounds"),
      inert_parameters(string, "project_seed"));
  const ParameterList limits = parameters_of<Path>("max_depth rr_depth");
  const ParameterList chains = inert_parameters(integer, "direct_samples luminance_samples");
  const ParameterList perturbations(
      inert_parameters(boolean,
                       "lens_perturbation multi_chain_perturbation caustic_perturbation "
                       "manifold_perturbation"),
      inert_parameters(number, "lambda"));
  const auto read_prb = &read_without_derivatives<Path>;
  constexpr const char* by_path = "by path; no derivatives";
  constexpr const char* by_nested = "by the integrator in it";
  return {
      {"prb", v3, prb, read_prb, by_path, approximated},
      {"prb_basic", v3, prb, read_prb, by_path, approximated},
      {"prb_projective", v3, projective, read_prb, by_path, approximated},
      {"prbvolpath", v3, prb, &read_without_derivatives<VolumePathIntegratorDescription>,
       "by volpath; no derivatives", approximated},
      {"direct_projective", v3, projective, &read_direct_projective, "by direct; no derivatives",
       approximated},
      {.name = "stokes",
       .versions = v3,
       .reader = &read_as_nested,
       .note = "by the integrator in it: light has no polarisation here",
       .support = approximated},
      stand_in_0x("mlt",
                  {limits, chains, inert_parameters(boolean, "two_stage bidirectional_mutation"),
                   perturbations},
                  &read_metropolis, "by bdpt"),
      stand_in_0x("erpt",
                  {limits, inert_parameters(number, "num_chains max_chains"),
                   inert_parameters(integer, "chain_length direct_samples"), perturbations},
                  &read_metropolis, "by bdpt"),
      stand_in_0x("pssmlt",
                  {limits, chains, inert_parameters(boolean, "two_stage bidirectional"),
                   inert_parameters(number, "p_large")},
                  &read_metropolis, "by bdpt"),
      stand_in_0x("vpl",
                  {depth_limit("5"), Parameter{"rr_depth", integer, "5", "", any, both, inert},
                   inert_parameters(integer, "shadow_map_resolution"),
                   inert_parameters(number, "clamping")},
                  &read_vpl, "by path"),
      stand_in_0x("irrcache",
                  {inert_parameters(integer, "resolution"), inert_parameters(number, "quality"),
                   inert_parameters(boolean, "gradients clamp_neighbor clamp_screen overture"),
                   inert_parameters(number, "quality_adjustment"),
                   inert_parameters(boolean, "indirect_only debug")},
                  &read_as_nested, by_nested),
      stand_in_0x(
          "adaptive",
          {inert_parameters(number, "max_error"), inert_parameters(integer, "max_sample_factor"),
           inert_parameters(number, "p_value")},
          &read_as_nested, by_nested),
  };
}

}  // namespace duet::plugins
