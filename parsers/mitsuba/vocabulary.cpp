#include "mitsuba/vocabulary.h"

#include <array>

#include "mitsuba/plugins/tables.h"
#include "scene/field_parameters.h"
#include "values/text.h"

namespace duet {

namespace {

using namespace parameter_words;

constexpr std::array<std::string_view, kPluginKinds> kTags{
    "scene", "integrator", "sensor",  "film",   "rfilter", "sampler", "shape",
    "bsdf",  "texture",    "emitter", "medium", "phase",   "volume",  "subsurface"};

constexpr Parameter kBsdfCommon[] = {{.name = "ensure_energy_conservation",
                                      .type = boolean,
                                      .preset = "true",
                                      .note = "scales reflectances above 1 down",
                                      .versions = v0}};
constexpr Parameter kShapeCommon[] = {
    {"to_world", transform, "", plugins::kMovable},
    {.name = "silhouette_sampling_weight", .type = number, .versions = v3, .support = inert}};
constexpr Parameter kTimeout{"timeout", number, "-1", "", any, v3, ignored};

/// Whether `name` is one of the words of `words`.
bool has_word(std::string_view words, std::string_view name) {
  while (!words.empty()) {
    const size_t end = words.find(' ');
    if (words.substr(0, end) == name) return true;
    words = end == std::string_view::npos ? std::string_view() : words.substr(end + 1);
  }
  return false;
}

}  // namespace

std::string_view tag_of(PluginKind kind) {
  return kTags[size_t(kind)];
}

std::optional<PluginKind> kind_of_tag(std::string_view tag) {
  for (size_t i = 0; i < kTags.size(); ++i)
    if (kTags[i] == tag) return PluginKind(i);
  return std::nullopt;
}

bool may_contain(PluginKind outer, PluginKind inner) {
  using enum PluginKind;
  switch (outer) {
    case PluginKind::scene:
      return inner != PluginKind::scene;
    case integrator:
      return inner == integrator || inner == PluginKind::texture;
    case sensor:
      return inner == film || inner == sampler || inner == medium || inner == PluginKind::texture ||
             inner == sensor || inner == shape;
    case film:
      return inner == rfilter || inner == PluginKind::texture;
    case shape:
      return inner == shape || inner == bsdf || inner == PluginKind::texture || inner == emitter ||
             inner == sensor || inner == medium || inner == subsurface || inner == rfilter;
    case bsdf:
      return inner == bsdf || inner == PluginKind::texture || inner == phase;
    case PluginKind::texture:
      return inner == PluginKind::texture || inner == volume;
    case emitter:
      return inner == PluginKind::texture || inner == medium || inner == volume;
    case medium:
      return inner == volume || inner == phase || inner == PluginKind::texture || inner == emitter;
    case phase:
      return inner == phase || inner == volume || inner == PluginKind::texture;
    case volume:
      return inner == volume || inner == PluginKind::texture;
    default:
      return false;
  }
}

std::string_view type_name(ParameterType type) {
  switch (type) {
    case ParameterType::boolean:
      return "boolean";
    case ParameterType::integer:
      return "integer";
    case ParameterType::number:
      return "float";
    case ParameterType::string:
      return "string";
    case ParameterType::point:
      return "point or vector";
    case ParameterType::transform:
      return "transform";
    case ParameterType::file:
      return "file name";
    case ParameterType::ior:
      return "float or name of a material";
    case ParameterType::texture:
      return "texture";
    case ParameterType::number_or_texture:
      return "float or texture";
    case ParameterType::reflectance:
    case ParameterType::unbounded:
    case ParameterType::emission:
      return "colour or texture";
    case ParameterType::volume_only:
      return "volume";
    case ParameterType::number_or_volume:
      return "float or volume";
    case ParameterType::albedo:
    case ParameterType::coefficient:
      return "colour or volume";
  }
  return "";
}

ParameterList inert_parameters(ParameterType type, std::string_view names, FileVersions versions) {
  std::vector<Parameter> list;
  for (const std::string_view name : split_list(names))
    list.push_back({.name = name, .type = type, .versions = versions, .support = Support::inert});
  return list;
}

const Vocabulary& Vocabulary::built_in() {
  static const Vocabulary all = [] {
    Vocabulary v;
    const auto add = [&](PluginKind kind, const auto& plugins) {
      v.plugins_[size_t(kind)].assign(plugins.begin(), plugins.end());
    };
    add(PluginKind::scene, plugins::scenes());
    add(PluginKind::integrator, plugins::integrators());
    add(PluginKind::sensor, plugins::sensors());
    add(PluginKind::film, plugins::films());
    add(PluginKind::rfilter, plugins::rfilters());
    add(PluginKind::sampler, plugins::samplers());
    add(PluginKind::shape, plugins::shapes());
    add(PluginKind::bsdf, plugins::bsdfs());
    add(PluginKind::texture, plugins::textures());
    add(PluginKind::emitter, plugins::emitters());
    add(PluginKind::medium, plugins::media());
    add(PluginKind::phase, plugins::phases());
    add(PluginKind::volume, plugins::volumes());
    add(PluginKind::subsurface, plugins::subsurfaces());
    return v;
  }();
  return all;
}

const Plugin* Vocabulary::find(PluginKind kind, std::string_view name) const {
  for (const Plugin& p : plugins(kind))
    if (p.name == name || has_word(p.aliases, name)) return &p;
  return nullptr;
}

std::vector<std::string> Vocabulary::names(PluginKind kind) const {
  std::vector<std::string> names;
  for (const Plugin& p : plugins(kind)) names.emplace_back(p.name);
  return names;
}

const ParameterList& common_parameters(PluginKind kind) {
  static const std::array<ParameterList, kPluginKinds> lists = [] {
    std::array<ParameterList, kPluginKinds> all;
    const auto list = [&](PluginKind k) -> ParameterList& { return all[size_t(k)]; };
    list(PluginKind::bsdf) = kBsdfCommon;
    list(PluginKind::shape) = kShapeCommon;
    list(PluginKind::emitter) = parameter<LightDescription>("sampling_weight");
    list(PluginKind::sensor) = plugins::sensor_parameters();
    list(PluginKind::film) = plugins::film_parameters();
    list(PluginKind::sampler) = plugins::sampler_parameters();
    list(PluginKind::integrator) = {kTimeout,
                                    inert_parameters(integer, "block_size samples_per_pass", v3)};
    return all;
  }();
  return lists[size_t(kind)];
}

const Parameter* find_parameter(PluginKind kind, const Plugin& plugin, std::string_view name) {
  const auto find = [&](const auto& list) -> const Parameter* {
    for (const Parameter& p : list)
      if (p.name == name || has_word(p.aliases, name)) return &p;
    return nullptr;
  };
  const Parameter* own = find(plugin.parameters);
  return own ? own : find(common_parameters(kind));
}

std::vector<std::string> parameter_names(PluginKind kind, const Plugin& plugin) {
  std::vector<std::string> names;
  for (const Parameter& p : plugin.parameters) names.emplace_back(p.name);
  for (const Parameter& p : common_parameters(kind)) names.emplace_back(p.name);
  return names;
}

}  // namespace duet
