#include "mitsuba/vocabulary.h"

#include <array>

#include "mitsuba/plugins/tables.h"
#include "scene/field_parameters.h"
#include "values/text.h"

namespace duet {

namespace {

using namespace parameter_words;

/// The elements of plugins, and which others may stand inside each.
struct Element {
  std::string_view tag, contents;
};
constexpr std::array<Element, kPluginKinds> kElements{
    {{"scene",
      "integrator sensor film rfilter sampler shape bsdf texture emitter medium phase volume "
      "subsurface"},
     {"integrator", "integrator texture"},
     {"sensor", "film sampler medium texture sensor shape"},
     {"film", "rfilter texture"},
     {"rfilter", ""},
     {"sampler", ""},
     {"shape", "shape bsdf texture emitter sensor medium subsurface rfilter"},
     {"bsdf", "bsdf texture phase"},
     {"texture", "texture volume"},
     {"emitter", "texture medium volume"},
     {"medium", "volume phase texture emitter"},
     {"phase", "phase volume texture"},
     {"volume", "volume texture"},
     {"subsurface", ""}}};

constexpr Parameter kEnsureConservation{"ensure_energy_conservation",       boolean, "true",
                                        "scales reflectances above 1 down", any,     v0};
constexpr Parameter kShapeCommon[] = {
    {"to_world", transform, "", plugins::kMovable},
    {.name = "silhouette_sampling_weight", .type = number, .versions = v3, .support = inert}};
constexpr Parameter kTimeout{"timeout", number, "-1", "", any, v3, ignored};

}  // namespace

std::string_view tag_of(PluginKind kind) {
  return kElements[size_t(kind)].tag;
}

std::optional<PluginKind> kind_of_tag(std::string_view tag) {
  for (size_t i = 0; i < kElements.size(); ++i)
    if (kElements[i].tag == tag) return PluginKind(i);
  return std::nullopt;
}

std::vector<std::string> tags_within_scenes() {
  std::vector<std::string> tags;
  for (const auto& element : kElements)
    if (element.tag != tag_of(PluginKind::scene)) tags.emplace_back(element.tag);
  return tags;
}

bool may_contain(PluginKind outer, PluginKind inner) {
  return has_word(kElements[size_t(outer)].contents, tag_of(inner));
}

std::vector<Plugin> plugins::joined(std::initializer_list<std::vector<Plugin>> lists) {
  std::vector<Plugin> all;
  for (const std::vector<Plugin>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

const Vocabulary& Vocabulary::built_in() {
  static const Vocabulary all = [] {
    using namespace plugins;
    Vocabulary v;
    // In the order of PluginKind.
    v.plugins_ = {scenes(),   integrators(), sensors(), films(),      rfilters(),
                  samplers(), shapes(),      bsdfs(),   textures(),   emitters(),
                  media(),    phases(),      volumes(), subsurfaces()};
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
    list(PluginKind::bsdf) = kEnsureConservation;
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
      if (is_called(p, name)) return &p;
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
