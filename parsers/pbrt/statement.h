// One directive with its parameters, as text.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "math/spectrum.h"
#include "math/transform.h"
#include "pbrt/vocabulary.h"

namespace duet::pbrt {

/// Names and types of the parameters are checked against the tables that the reader has: to write
/// what v4 does not have is a mistake of the program (std::logic_error).
class Statement {
 public:
  /// `directive "name"` of the plugin.
  Statement(std::string_view directive, std::string_view plugin)
      : Statement(directive, plugin, fmt::format("{} {}", directive, quoted(plugin))) {}
  /// `MakeNamedMaterial "name" "string type" "plugin"`; `kind` is the tables' directive.
  static Statement named(std::string_view directive, std::string_view kind, std::string_view name,
                         std::string_view plugin);
  /// `Texture "name" "float" "plugin"`.
  static Statement texture(std::string_view name, bool is_color, std::string_view plugin);

  Statement& number(std::string_view name, double value);
  Statement& integer(std::string_view name, int value);
  Statement& boolean(std::string_view name, bool value);
  Statement& string(std::string_view name, std::string_view value);
  Statement& strings(std::string_view name, const std::array<std::string, 2>& values);
  Statement& color(std::string_view name, const Spectrum& value);
  Statement& refer(std::string_view name, std::string_view texture);
  Statement& vector(std::string_view name, const std::array<double, 3>& value);
  /// Values of a type, one after the other.
  template <class T>
  Statement& list(std::string_view name, Type type,
                  std::span<const std::type_identity_t<T>> values);

  /// With the end of the line.
  std::string text() const { return text_ + "\n"; }

  static std::string quoted(std::string_view text);

 private:
  Statement(std::string_view kind, std::string_view plugin, std::string text);
  void begin(std::string_view name, Type type);

  const Row* row_;
  std::string text_;
};

template <class T>
Statement& Statement::list(std::string_view name, Type type,
                           std::span<const std::type_identity_t<T>> values) {
  begin(name, type);
  text_ += "[";
  // Lines of a length that editors bear.
  for (size_t i = 0; i < values.size(); ++i)
    fmt::format_to(std::back_inserter(text_), "{}{}",
                   i == 0        ? ""
                   : i % 24 == 0 ? "\n    "
                                 : " ",
                   values[i]);
  text_ += "]";
  return *this;
}

/// "Transform [ … ]\n": a matrix as pbrt has it, the translation last.
std::string transform_text(const Matrix4& m, std::string_view directive = "Transform");

}  // namespace duet::pbrt
