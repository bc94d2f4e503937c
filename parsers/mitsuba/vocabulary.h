// Every plugin and parameter of Mitsuba 0.4 to 3, and Duet's own: the one table that reading,
// messages, the list of plugins and the documentation are made from.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mitsuba/color.h"
#include "scene/description.h"

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
/// Which plugins may stand inside others.
bool may_contain(PluginKind outer, PluginKind inner);

enum class ParameterType : uint8_t {
  boolean,
  integer,
  number,
  string,
  point,  ///< or a vector: three numbers
  transform,
  file,  ///< a string that names a file
  ior,   ///< index of refraction, by number or by the name of a material
  texture,
  number_or_texture,
  reflectance,  ///< a colour from 0 to 1, or a texture
  unbounded,    ///< a colour without upper bound, or a texture
  emission,     ///< radiance or power, or a texture
  volume_only,
  number_or_volume,
  albedo,       ///< a colour from 0 to 1, or a volume
  coefficient,  ///< a colour without upper bound, or a volume
};
std::string_view type_name(ParameterType type);

/// The values that a number may have.
enum class NumberRange : uint8_t {
  any,
  positive,
  not_negative,
  size,
  depth,
  degrees,
  fraction,     ///< from 0 to 1
  probability,  ///< the same without 0
};

/// Which files know a name. It is understood in all files: people mix versions.
enum class FileVersions : uint8_t { all, v0, v3 };

enum class Support : uint8_t {
  done,
  approximated,
  inert,    ///< changes nothing that Duet does: accepted without a word
  ignored,  ///< would change something but not the linear image: accepted with a warning
  refused,  ///< known, never supported: the note says why
};

struct Parameter {
  std::string_view name;  ///< in Mitsuba 3; snake_case
  ParameterType type;
  /// What holds if it is not given, as text. Empty: there is no such value. In parentheses: words.
  std::string_view preset = "";
  std::string_view note = "";
  NumberRange range = NumberRange::any;
  FileVersions versions = FileVersions::all;
  Support support = Support::done;
  /// In 0.x files, if that is different.
  std::string_view preset_0x = "";
  /// Further names, besides the camelCase form; separated by spaces.
  std::string_view aliases = "";
  bool required = false;
};

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
  std::string_view name;
  FileVersions versions = FileVersions::all;
  std::span<const Parameter> parameters = {};
  PluginReader reader = {};
  std::string_view note = "";
  Support support = Support::done;
  std::string_view aliases = "";
  /// The names of its parameters, separated by spaces, if it is refused.
  std::string_view refused_parameters = "";
};

/// The plugins of a kind, and the parameters that all of them have.
std::span<const Plugin> plugins(PluginKind kind);
std::span<const Parameter> common_parameters(PluginKind kind);

/// Null if there is no plugin of that name or alias.
const Plugin* find_plugin(PluginKind kind, std::string_view name);
std::vector<std::string> plugin_names(PluginKind kind);
/// The parameter of that name or alias (in snake_case); null if the plugin has none.
const Parameter* find_parameter(PluginKind kind, const Plugin& plugin, std::string_view name);
std::vector<std::string> parameter_names(PluginKind kind, const Plugin& plugin);

}  // namespace duet
