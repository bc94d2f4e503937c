// Every plugin and parameter of Mitsuba 0.4 to 3, and Duet's own: the one table that reading,
// messages, the list of plugins and the documentation are made from. What is known of a BSDF comes
// from its description (scene/field.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/description.h"
#include "scene/parameter_text.h"
#include "values/color.h"
#include "values/parameter_list.h"

namespace duet {

/// What a plugin is; the names of the elements that hold them.
enum class PluginKind : uint8_t {
  scene,
  integrator,
  sensor,
  film,
  rfilter,
  sampler,
  shape,
  bsdf,
  texture,
  emitter,
  medium,
  phase,
  volume,
  subsurface,
};
inline constexpr int kPluginKinds = 14;

std::string_view tag_of(PluginKind kind);
std::optional<PluginKind> kind_of_tag(std::string_view tag);
/// Of all kinds but `scene`.
std::vector<std::string> tags_within_scenes();
/// Which plugins may stand inside others.
bool may_contain(PluginKind outer, PluginKind inner);

class SceneReader;
class Properties;
/// What a plugin without spatial variation yields, in the meaning that its user asks for.
struct MeantColor {
  ColorMeaning meaning;
  Spectrum value;
};
/// What a volume yields in the meaning that its user asks for.
struct MeantVolume {
  ColorMeaning meaning;
  ColorVolume value;
};
/// What a plugin yields that stands for any number of shapes.
struct ShapeList {
  std::vector<ShapeDescription> shapes;
};
/// Turns the properties of a plugin into a part of the description.
template <class T>
using ReadInto = void (*)(SceneReader&, Properties&, T&);
using PluginReader =
    std::variant<std::monostate, ReadInto<MaterialDescription>, ReadInto<TextureDescription>,
                 ReadInto<MeantColor>, ReadInto<ShapeDescription>, ReadInto<ShapeList>,
                 ReadInto<ShapeGroupDescription>, ReadInto<AreaEmission>,
                 ReadInto<LightDescription>, ReadInto<SensorDescription>,
                 ReadInto<MediumDescription>, ReadInto<PhaseDescription>, ReadInto<MeantVolume>,
                 ReadInto<FilmDescription>, ReadInto<FilterDescription>,
                 ReadInto<SamplerDescription>, ReadInto<IntegratorDescription>>;

struct Plugin {
  std::string_view name = "";
  FileVersions versions = FileVersions::all;
  ParameterList parameters = {};
  PluginReader reader = {};
  std::string_view note = "";
  Support support = Support::done;
  std::string_view aliases = "";
  /// The names of its parameters, separated by spaces, if it is refused.
  std::string_view refused_parameters = "";
};

/// The parameters that all plugins of a kind have.
const ParameterList& common_parameters(PluginKind kind);
/// The parameter of that name or alias (in snake_case); null if the plugin has none.
const Parameter* find_parameter(PluginKind kind, const Plugin& plugin, std::string_view name);
std::vector<std::string> parameter_names(PluginKind kind, const Plugin& plugin);

/// All plugins that a reader knows. A copy can be given more of them.
class Vocabulary {
 public:
  /// Those of Mitsuba 0.4 to 3, and Duet's own.
  static const Vocabulary& built_in();

  void add(PluginKind kind, const Plugin& plugin) { plugins_[size_t(kind)].push_back(plugin); }
  const std::vector<Plugin>& plugins(PluginKind kind) const { return plugins_[size_t(kind)]; }
  /// Null if there is no plugin of that name or alias.
  const Plugin* find(PluginKind kind, std::string_view name) const;
  std::vector<std::string> names(PluginKind kind) const;

 private:
  std::array<std::vector<Plugin>, kPluginKinds> plugins_;
};

}  // namespace duet
