// Parameters of pbrt's plugins: as a file gives them, and what the reader knows of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "pbrt/lexer.h"
#include "values/report.h"

namespace duet::pbrt {

/// The versions of the format that are read. Files do not say theirs.
enum class Version : uint8_t { v3 = 3, v4 = 4 };

/// What a parameter is declared as.
enum class Type : uint8_t {
  integer,
  number,  ///< "float"
  boolean,
  string,
  point2,
  vector2,
  point3,
  vector3,
  normal,
  rgb,
  xyz,
  blackbody,
  spectrum,  ///< pairs of wavelength and value, or the name of a spectrum or of a file
  texture,
};
/// Its name in v4.
const char* type_name(Type type);
/// v3's further names ("color", "point", "vector") included.
std::optional<Type> find_type(std::string_view name);

/// A set of types.
using Types = uint16_t;
constexpr Types of(Type t) {
  return Types(1u << unsigned(t));
}
inline constexpr Types kInteger = of(Type::integer), kNumber = of(Type::number),
                       kBoolean = of(Type::boolean), kString = of(Type::string),
                       kPoint2 = of(Type::point2) | of(Type::vector2) | of(Type::number),
                       kPoint3 = of(Type::point3), kVector3 = of(Type::vector3),
                       kNormal = of(Type::normal), kTexture = of(Type::texture),
                       kColor =
                           of(Type::rgb) | of(Type::xyz) | of(Type::blackbody) | of(Type::spectrum),
                       kIndex = kNumber | of(Type::spectrum) | of(Type::rgb),
                       kColorTexture = kColor | kTexture, kNumberTexture = kNumber | kTexture;

/// One parameter of a file.
struct Parameter {
  Type type = Type::number;
  std::string name;
  SourceLocation where;
  std::vector<double> numbers;  ///< of numbers, points, colours …; of booleans 0 or 1
  std::vector<std::string> strings;
  uint8_t color_space = 0;  ///< of the graphics state where it stands
  bool is_default = false;  ///< of Attribute: not everything in the block has such a parameter
};

/// A directive with parameters: `directive "name" parameters`.
struct Plugin {
  std::string directive;
  std::string name;
  SourceLocation where;
  std::vector<Parameter> parameters;

  const Parameter* find(std::string_view parameter) const;
};

/// Reads parameters until something else than a string comes. What is wrong is reported, and left
/// out.
std::vector<Parameter> read_parameters(Lexer& in, uint8_t color_space, Report& report);

struct Spec;
/// Reads `"name" value` of an option: pbrt gives it no type (but one may stand before the name),
/// and takes no notice of case, dashes and underscores in the name, which the result is without.
Parameter read_option(Lexer& in, std::span<const Spec> known);

/// How much of a plugin or parameter there is.
enum class Status : uint8_t {
  done,
  approximated,
  inert,    ///< changes nothing that Duet does: accepted without a word
  ignored,  ///< would change the image: accepted with a warning
  refused,  ///< an error; the note says why
};
/// Which files have it.
enum class Versions : uint8_t { both, v3, v4 };
constexpr bool has_version(Versions versions, Version v) {
  return versions == Versions::both || (versions == Versions::v3) == (v == Version::v3);
}

/// What is known of a parameter.
struct Spec {
  std::string_view name;
  Types types;
  /// What holds if it is not given, as text. Empty: there is no such value.
  std::string_view preset = "";
  std::string_view note = "";
  /// How many values there must be, each of as many numbers as its type has; 0: any number.
  int count = 1;
  Status status = Status::done;
  Versions versions = Versions::both;
  /// In v3 files, if that is different.
  std::string_view preset_v3 = "";
};

}  // namespace duet::pbrt
