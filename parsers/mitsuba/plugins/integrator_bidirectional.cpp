// Integrators that trace sub-paths from the lights, too.
#include "mitsuba/plugins/integrators.h"

namespace duet::plugins {

namespace {

using Bidirectional = BidirectionalIntegratorDescription;

ReuseWeights read_reuse_weights(Properties& p) {
  const bool thesis = p.choice<bool>("weights", {{"exact", false}, {"thesis", true}});
  const auto reading = p.choice<ReuseWeights>(
      "thesis_reading", {{"a", ReuseWeights::thesis_a}, {"b", ReuseWeights::thesis_b}});
  if (thesis) return reading;
  if (p.has("thesis_reading"))
    p.error("thesis_reading", "\"thesis_reading\" is only for the \"weights\" \"thesis\"");
  return ReuseWeights::exact;
}

/// Guards against slips of the pen that would fill the memory.
void check_most(Properties& p, const Bidirectional& d) {
  constexpr int most = 1 << 16;
  const auto check = [&](std::string_view name, std::string_view what, double value) {
    if (value > most) p.error(name, "more than {} {} are too many", most, what);
  };
  check("light_paths", "light sub-paths for each pixel", d.light_paths);
  check("connections", "connections of an eye vertex", d.connections);
  check("max_eye_depth", "segments of a sub-path", d.max_eye_depth);
  check("max_light_depth", "segments of a sub-path", d.max_light_depth);
}

template <BidirectionalMethod kMethod>
void read_bidirectional(SceneReader& s, Properties& p, IntegratorDescription& out) {
  Bidirectional d;
  d.method = kMethod;
  read_values(s, p, d);
  check_most(p, d);
  check_pixel_group(p, d.pixel_group);
  if (kMethod == BidirectionalMethod::reuse) d.weights = read_reuse_weights(p);
  out.method = d;
}

/// Photon mapping; what Mitsuba 0.x means by it is approximated.
void read_ppm(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const std::string_view name = p.node().plugin->name;
  if (p.is_0x() || name != "ppm")
    s.approximate_loudly(
        p.node().where,
        fmt::format("the integrator \"{}\" of Mitsuba 0.6 is approximated by Duet's \"ppm\"",
                    name));
  read_bidirectional<BidirectionalMethod::ppm>(s, p, out);
}

Parameter depth_with_note(std::string_view note) {
  Parameter p = parameter<Bidirectional>("max_depth");
  p.note = note;
  return p;
}

ParameterList of(std::string_view names) {
  return parameters_of<Bidirectional>(names);
}

constexpr Parameter kGranularity{
    .name = "granularity", .type = integer, .versions = v0, .support = inert};

/// Those of `ppm` and `sppm`, two of whose defaults are others in 0.x.
ParameterList photon_parameters() {
  return {
      of("max_depth"),
      with_preset_0x(parameter<Bidirectional>("rr_depth"), "3"),
      of("hide_emitters strict_normals light_selection light_paths guide_emission radius"),
      with_preset_0x(parameter<Bidirectional>("alpha"), "0.7"),
      Parameter{"photon_count", integer, "", "light_paths decides", any, v0, inert},
      Parameter{"max_passes", integer, "", "the sampler's sample_count decides", any, v0, inert},
      kGranularity};
}

}  // namespace

std::vector<Plugin> bidirectional_integrators() {
  using enum BidirectionalMethod;
  const ParameterList eye_paths =
      of("max_depth rr_depth hide_emitters strict_normals light_selection");
  const ParameterList light_paths = of("light_paths guide_emission");
  const ParameterList merging = of("radius alpha");
  return {
      {"ptracer",
       both,
       {of("max_depth rr_depth hide_emitters"), light_paths, kGranularity,
        Parameter{"brute_force", boolean, "false", "connecting to the camera has the same mean",
                  any, v0, inert}},
       &read_bidirectional<ptracer>,
       "light tracing: paths from the lights, connected to the camera"},
      {"bdpt",
       v0,
       {eye_paths, of("light_image"), inert_parameters(boolean, "sample_direct"), light_paths,
        of("connections pixel_group")},
       &read_bidirectional<bdpt>,
       "bidirectional path tracing"},
      {"reuse",
       both,
       {depth_with_note("longest path in segments; -1: no limit, but max_eye_depth + "
                        "max_light_depth + 1 with the weights of the thesis"),
        of("rr_depth hide_emitters strict_normals light_selection"), light_paths,
        of("max_eye_depth max_light_depth weights thesis_reading continue_probability")},
       &read_bidirectional<reuse>,
       "Duet's own: bidirectional path tracing that reuses light sub-paths"},
      {"ppm", both, photon_parameters(), &read_ppm,
       "Duet's own: progressive photon mapping; approximates that of 0.x"},
      {"bpm",
       both,
       {eye_paths, light_paths, merging},
       &read_bidirectional<bpm>,
       "Duet's own: bidirectional photon mapping"},
      {"vcm",
       both,
       {eye_paths, light_paths, of("connections"), merging},
       &read_bidirectional<vcm>,
       "Duet's own: vertex connection and merging"},
      {"sppm", v0, photon_parameters(), &read_ppm, "by ppm", approximated},
      {"photonmapper",
       v0,
       {of("max_depth rr_depth hide_emitters"),
        inert_parameters(integer,
                         "direct_samples glossy_samples global_photons caustic_photons "
                         "volume_photons"),
        inert_parameters(number, "global_lookup_radius caustic_lookup_radius"),
        inert_parameters(integer, "lookup_size granularity")},
       &read_ppm,
       "by ppm",
       approximated},
  };
}

}  // namespace duet::plugins
