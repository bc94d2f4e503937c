// Integrators of Mitsuba that another method stands in for: said in a warning, each by name.
#include <algorithm>
#include <array>

#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

namespace {

void note(SceneReader& s, const Properties& p, std::string_view method, std::string_view why = "") {
  s.approximate_loudly(p.node().where,
                       fmt::format("the integrator \"{}\" is run as \"{}\"{}{}",
                                   p.node().plugin->name, method, why.empty() ? "" : ": ", why));
}

constexpr std::string_view kNoDerivatives = "images are the same, derivatives are not computed";

/// The layer that a `field` integrator of 0.6 makes; nothing after an error.
std::optional<std::string> field_layer(Properties& p) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> layers{
      {{"position", "position"},
       {"distance", "depth"},
       {"geo_normal", "geo_normal"},
       {"sh_normal", "sh_normal"},
       {"uv", "uv"},
       {"albedo", "albedo"},
       {"shape_index", "shape_index"},
       {"prim_index", "prim_index"}}};
  if (!p.find("field")) return std::nullopt;
  const std::string field = p.string("field");
  const std::string name = snake_case(field);
  std::vector<std::string> names;
  for (const auto& [from, to] : layers) {
    if (name == from) return std::string(to);
    names.emplace_back(camel_case(from));
  }
  if (name == "rel_position")
    p.error("field", "positions relative to the camera (\"relPosition\") are not computed");
  else
    p.error("field", "unknown field {}{}", in_quotes(field), did_you_mean(field, names));
  return std::nullopt;
}

/// Of methods that only Mitsuba 3 has, where there are no strict normals.
PathLimits read_limits(Properties& p) {
  return {p.integer("max_depth"), p.integer("rr_depth"), p.boolean("hide_emitters")};
}

/// The integrator that stands in `p`; null after an error.
const Node* nested_integrator(SceneReader& s, Properties& p) {
  const Node* nested = p.child(PluginKind::integrator);
  if (!nested) s.report().error(p.node().where, "{} needs an integrator", describe(p.node()));
  return nested;
}

}  // namespace

void read_prb(SceneReader& s, Properties& p, IntegratorDescription& out) {
  out.method = PathIntegratorDescription{read_limits(p)};
  note(s, p, "path", kNoDerivatives);
}

void read_prbvolpath(SceneReader& s, Properties& p, IntegratorDescription& out) {
  out.method = VolumePathIntegratorDescription{read_limits(p)};
  note(s, p, "volpath", kNoDerivatives);
}

void read_direct_projective(SceneReader& s, Properties& p, IntegratorDescription& out) {
  DirectIntegratorDescription direct;
  direct.hide_emitters = p.boolean("hide_emitters");
  out.method = direct;
  note(s, p, "direct", kNoDerivatives);
}

void read_metropolis(SceneReader& s, Properties& p, IntegratorDescription& out) {
  BidirectionalIntegratorDescription d;
  d.max_depth = p.integer("max_depth");
  d.rr_depth = p.integer("rr_depth");
  out.method = d;
  note(s, p, "bdpt");
}

void read_vpl(SceneReader& s, Properties& p, IntegratorDescription& out) {
  PathIntegratorDescription path;
  path.max_depth = p.integer("max_depth");
  out.method = path;
  note(s, p, "path");
}

void read_irrcache(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const Node* nested = nested_integrator(s, p);
  if (nested && s.read_into(*nested, out))
    note(s, p, nested->type, "irradiance is computed at every point, not cached");
}

void read_adaptive(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const Node* nested = nested_integrator(s, p);
  if (nested && s.read_into(*nested, out))
    note(s, p, nested->type, "every pixel gets the same number of samples");
}

void read_stokes(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const Node* nested = nested_integrator(s, p);
  if (nested && s.read_into(*nested, out))
    note(s, p, nested->type, "light has no polarisation here, so S1 to S3 are missing");
}

void read_field(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const auto layer = field_layer(p);
  if (!layer) return;
  out.image = false;
  out.aovs.layers.push_back({*layer, *layer});
  note(s, p, "aov", fmt::format("the layer is called \"{}\"", *layer));
}

void read_multichannel(SceneReader& s, Properties& p, IntegratorDescription& out) {
  IntegratorDescription whole;
  whole.where = out.where;
  whole.image = false;
  for (const Properties::Child& child : p.children(PluginKind::integrator)) {
    IntegratorDescription part;
    if (!s.read_into(*child.node, part)) continue;
    if (part.image && whole.image) {
      s.report().error(child.node->where, "{} can hold one integrator that makes colours, not two",
                       describe(p.node()));
      continue;
    }
    if (part.image) whole.image = true, whole.method = part.method, whole.moments = part.moments;
    for (AovDescription::Layer& layer : part.aovs.layers) {
      const auto same = [&](const auto& l) { return l.name == layer.name; };
      auto& layers = whole.aovs.layers;
      if (std::find_if(layers.begin(), layers.end(), same) == layers.end())
        layers.push_back(std::move(layer));
    }
  }
  if (!whole.image && whole.aovs.layers.empty())
    s.report().error(p.node().where, "{} needs an integrator", describe(p.node()));
  out = std::move(whole);
}

}  // namespace duet
