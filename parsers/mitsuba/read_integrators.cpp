// Integrators: methods, and wrappers around them.
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

namespace {

const std::vector<std::string>& layer_kinds() {
  static const std::vector<std::string> kinds{
      "albedo", "depth", "position", "uv",     "geo_normal", "sh_normal",
      "dp_du",  "dp_dv", "duv_dx",   "duv_dy", "prim_index", "shape_index"};
  return kinds;
}

PathLimits read_path_limits(Properties& p) {
  return {p.integer("max_depth"), p.integer("rr_depth"), p.boolean("hide_emitters"),
          p.boolean("strict_normals")};
}

void read_layers(Properties& p, AovDescription& out) {
  if (!p.find("aovs")) return;
  const std::string text = p.string("aovs");
  const auto parts = split_list(text);
  if (parts.empty()) p.error("aovs", "no layer is listed");
  for (std::string_view part : parts) {
    const size_t colon = part.find(':');
    const std::string name(part.substr(0, colon));
    const std::string kind(colon == part.npos ? "" : part.substr(colon + 1));
    const auto& kinds = layer_kinds();
    const auto same_name = [&](const auto& layer) { return layer.name == name; };
    if (name.empty() || kind.empty())
      p.error("aovs", "{} is not of the form name:kind", in_quotes(part));
    else if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      p.error("aovs", "unknown kind of layer {}{}", in_quotes(kind), did_you_mean(kind, kinds));
    else if (std::any_of(out.layers.begin(), out.layers.end(), same_name))
      p.error("aovs", "two layers are called {}", in_quotes(name));
    else
      out.layers.push_back({kind, name});
  }
}

}  // namespace

void read_path(SceneReader&, Properties& p, IntegratorDescription& out) {
  out.method = PathIntegratorDescription{read_path_limits(p)};
}

void read_volpath(SceneReader&, Properties& p, IntegratorDescription& out) {
  VolumePathIntegratorDescription path{read_path_limits(p)};
  if (p.node().type == "volpathmis") path.name = VolumePathName::volpathmis;
  out.method = path;
}

void read_direct(SceneReader&, Properties& p, IntegratorDescription& out) {
  DirectIntegratorDescription direct;
  if (p.has("shading_samples")) {
    if (!p.is_0x() && (p.has("emitter_samples") || p.has("bsdf_samples")))
      p.error(
          "shading_samples",
          "either \"shading_samples\" or \"emitter_samples\" and \"bsdf_samples\" can be given");
    direct.emitter_samples = direct.bsdf_samples = p.integer("shading_samples");
  }
  if (p.has("emitter_samples")) direct.emitter_samples = p.integer("emitter_samples");
  if (p.has("bsdf_samples")) direct.bsdf_samples = p.integer("bsdf_samples");
  constexpr int most = 1 << 16;
  if (direct.emitter_samples == 0 && direct.bsdf_samples == 0)
    p.error("bsdf_samples", "at least one sample must be taken of emitters or of BSDFs");
  if (std::max(direct.emitter_samples, direct.bsdf_samples) > most)
    p.error(direct.emitter_samples > most && p.has("emitter_samples") ? "emitter_samples"
            : p.has("bsdf_samples")                                   ? "bsdf_samples"
                                                                      : "shading_samples",
            "more than {} samples at each hit are too many", most);
  direct.hide_emitters = p.boolean("hide_emitters");
  direct.strict_normals = p.boolean("strict_normals");
  out.method = direct;
}

void read_auto(SceneReader&, Properties& p, IntegratorDescription& out) {
  out.method = AutoIntegratorDescription{read_path_limits(p)};
}

void read_depth(SceneReader&, Properties&, IntegratorDescription& out) {
  out.method = DepthIntegratorDescription{};
}

void read_ao(SceneReader&, Properties& p, IntegratorDescription& out) {
  OcclusionIntegratorDescription ao;
  ao.shading_samples = p.integer("shading_samples");
  ao.ray_length = std::max(p.number("ray_length"), 0.0);
  out.method = ao;
}

void read_aov(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const Node* nested = p.child(PluginKind::integrator);
  if (nested)
    s.read_into(*nested, out);
  else
    out.image = false;
  read_layers(p, out.aovs);
}

void read_moment(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const Node* nested = p.child(PluginKind::integrator);
  if (!nested) {
    s.report().error(p.node().where, "{} needs an integrator", describe(p.node()));
    return;
  }
  s.read_into(*nested, out);
  out.moments = true;
}

}  // namespace duet
