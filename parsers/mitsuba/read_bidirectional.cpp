// Integrators that trace sub-paths from the lights, too.
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"

namespace duet {

namespace {

/// What all of them have.
BidirectionalIntegratorDescription read_paths(Properties& p, BidirectionalMethod method) {
  BidirectionalIntegratorDescription d;
  d.method = method;
  d.max_depth = p.integer("max_depth");
  d.rr_depth = p.integer("rr_depth");
  d.hide_emitters = p.boolean("hide_emitters");
  return d;
}

/// Guards against slips of the pen that would fill the memory.
template <class T>
T check_most(Properties& p, std::string_view name, std::string_view what, T value) {
  constexpr int most = 1 << 16;
  if (value > most) p.error(name, "more than {} {} are too many", most, what);
  return value;
}

double read_light_paths(Properties& p) {
  return check_most(p, "light_paths", "light sub-paths for each pixel", p.number("light_paths"));
}

int read_connections(Properties& p) {
  return check_most(p, "connections", "connections of an eye vertex", p.integer("connections"));
}

BidirectionalIntegratorDescription read_merging(Properties& p, BidirectionalMethod method) {
  BidirectionalIntegratorDescription d = read_paths(p, method);
  d.strict_normals = p.boolean("strict_normals");
  d.light_paths = read_light_paths(p);
  d.radius = p.number("radius");
  d.alpha = p.number("alpha");
  return d;
}

void note_photon_mapping(SceneReader& s, const Properties& p) {
  s.approximate_loudly(
      p.node().where,
      fmt::format("the integrator \"{}\" of Mitsuba 0.6 is approximated by Duet's \"ppm\"",
                  p.node().plugin->name));
}

ReuseWeights read_reuse_weights(Properties& p) {
  const bool thesis = p.choice<bool>("weights", {{"exact", false}, {"thesis", true}});
  const auto reading = p.choice<ReuseWeights>(
      "thesis_reading", {{"a", ReuseWeights::thesis_a}, {"b", ReuseWeights::thesis_b}});
  if (thesis) return reading;
  if (p.has("thesis_reading"))
    p.error("thesis_reading", "\"thesis_reading\" is only for the \"weights\" \"thesis\"");
  return ReuseWeights::exact;
}

}  // namespace

void read_ptracer(SceneReader&, Properties& p, IntegratorDescription& out) {
  auto ptracer = read_paths(p, BidirectionalMethod::ptracer);
  ptracer.light_paths = read_light_paths(p);
  out.method = ptracer;
}

void read_bdpt(SceneReader&, Properties& p, IntegratorDescription& out) {
  auto bdpt = read_paths(p, BidirectionalMethod::bdpt);
  bdpt.strict_normals = p.boolean("strict_normals");
  bdpt.light_image = p.boolean("light_image");
  bdpt.light_paths = read_light_paths(p);
  bdpt.connections = read_connections(p);
  out.method = bdpt;
}

void read_reuse(SceneReader&, Properties& p, IntegratorDescription& out) {
  auto reuse = read_paths(p, BidirectionalMethod::reuse);
  reuse.strict_normals = p.boolean("strict_normals");
  reuse.light_paths = read_light_paths(p);
  constexpr std::string_view segments = "segments of a sub-path";
  reuse.max_eye_depth = check_most(p, "max_eye_depth", segments, p.integer("max_eye_depth"));
  reuse.max_light_depth = check_most(p, "max_light_depth", segments, p.integer("max_light_depth"));
  reuse.weights = read_reuse_weights(p);
  reuse.continue_probability = p.number("continue_probability");
  out.method = reuse;
}

void read_ppm(SceneReader& s, Properties& p, IntegratorDescription& out) {
  if (p.is_0x()) note_photon_mapping(s, p);
  out.method = read_merging(p, BidirectionalMethod::ppm);
}

void read_sppm(SceneReader& s, Properties& p, IntegratorDescription& out) {
  note_photon_mapping(s, p);
  out.method = read_merging(p, BidirectionalMethod::ppm);
}

void read_photonmapper(SceneReader& s, Properties& p, IntegratorDescription& out) {
  note_photon_mapping(s, p);
  out.method = read_paths(p, BidirectionalMethod::ppm);
}

void read_bpm(SceneReader&, Properties& p, IntegratorDescription& out) {
  out.method = read_merging(p, BidirectionalMethod::bpm);
}

void read_vcm(SceneReader&, Properties& p, IntegratorDescription& out) {
  auto vcm = read_merging(p, BidirectionalMethod::vcm);
  vcm.connections = read_connections(p);
  out.method = vcm;
}

}  // namespace duet
