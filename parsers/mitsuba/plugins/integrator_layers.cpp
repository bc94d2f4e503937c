// Integrators that make layers of the image, and those that hold other integrators.
#include <algorithm>

#include "mitsuba/plugins/integrators.h"
#include "values/text.h"

namespace duet::plugins {

const Node* nested_integrator(Properties& p) {
  const Node* nested = p.child(PluginKind::integrator);
  if (!nested) p.needs("an integrator");
  return nested;
}

const std::vector<std::string>& layer_kinds() {
  static const std::vector<std::string> kinds{
      "albedo", "depth", "position", "uv",     "geo_normal", "sh_normal",
      "dp_du",  "dp_dv", "duv_dx",   "duv_dy", "prim_index", "shape_index"};
  return kinds;
}

namespace {

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

/// The layer that a `field` integrator of 0.6 makes; nothing after an error.
std::optional<std::string> field_layer(Properties& p) {
  constexpr std::string_view fields[] = {"position", "distance", "geo_normal",  "sh_normal",
                                         "uv",       "albedo",   "shape_index", "prim_index"};
  if (!p.find("field")) return std::nullopt;
  const std::string field = p.string("field");
  const std::string name = snake_case(field);
  std::vector<std::string> names;
  for (const std::string_view known : fields) {
    if (name == known) return name == "distance" ? "depth" : name;
    names.emplace_back(camel_case(known));
  }
  if (name == "rel_position")
    p.error("field", "positions relative to the camera (\"relPosition\") are not computed");
  else
    p.error("field", "unknown field {}{}", in_quotes(field), did_you_mean(field, names));
  return std::nullopt;
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
  const Node* nested = nested_integrator(p);
  if (!nested) return;
  s.read_into(*nested, out);
  out.moments = true;
}

void read_field(SceneReader& s, Properties& p, IntegratorDescription& out) {
  const auto layer = field_layer(p);
  if (!layer) return;
  out.image = false;
  out.aovs.layers.push_back({*layer, *layer});
  note_substitute(s, p, "aov", fmt::format("the layer is called \"{}\"", *layer));
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
  if (!whole.image && whole.aovs.layers.empty()) p.needs("an integrator");
  out = std::move(whole);
}

}  // namespace

Plugin aov() {
  constexpr Parameter aovs{
      .name = "aovs",
      .type = string,
      .note =
          "name:kind, …; albedo depth position uv geo_normal sh_normal dp_du dp_dv "
          "prim_index shape_index, and duv_dx duv_dy, which are per pixel: Mitsuba 3.9.1 "
          "divides them by the square root of the sample count",
      .required = true};
  return {
      "aov",
      v3,
      {aovs, inert_parameters(boolean, "hide_emitters")},
      &read_aov,
      "may hold an integrator; its image is R, G, B, not repeated as name.R and so on, and layers "
      "of one within it keep their names"};
}

Plugin moment() {
  return {"moment", v3, inert_parameters(boolean, "hide_emitters"), &read_moment,
          "holds an integrator; the layer is called m2 with R, G, B, not m2_name with X, Y, Z"};
}

Plugin field_integrator() {
  constexpr Parameter field{
      .name = "field",
      .type = string,
      .note = "position, distance, geoNormal, shNormal, uv, albedo, shapeIndex, primIndex",
      .required = true};
  constexpr Parameter undefined{"undefined", number, "", "0", any, both, inert};
  return {"field", v0, {field, undefined}, &read_field, "by aov", approximated};
}

Plugin multichannel() {
  return {.name = "multichannel",
          .versions = v0,
          .reader = &read_multichannel,
          .note = "holds one integrator that makes colours, and fields"};
}

}  // namespace duet::plugins
