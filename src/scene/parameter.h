// What a scene file may say of one parameter of a plugin: the facts that reading, messages, the
// list of plugins and the documentation are made from.
#pragma once

#include <cstdint>
#include <string_view>

namespace duet {

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

inline constexpr std::string_view kInitial = "=";

struct Parameter {
  std::string_view name;  ///< in Mitsuba 3; snake_case
  ParameterType type;
  /// What holds if it is not given, as text. Empty: there is no such value. In parentheses: words.
  /// kInitial: the value with which the field's member begins.
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

/// The names that tables of parameters are written with.
namespace parameter_words {
using enum ParameterType;
using enum NumberRange;
using enum Support;
inline constexpr FileVersions v0 = FileVersions::v0, v3 = FileVersions::v3,
                              both = FileVersions::all;
}  // namespace parameter_words

}  // namespace duet
