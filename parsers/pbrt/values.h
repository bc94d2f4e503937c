// The parameters of one plugin, checked against what is known of them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pbrt/reader.h"
#include "pbrt/spectra.h"

namespace duet::pbrt {

class Values {
 public:
  /// Reports what is wrong with the parameters: unknown names, wrong types and counts. Those count
  /// as not given. The arguments must outlive this.
  Values(Reader& reader, const Plugin& plugin, std::span<const Spec> specs,
         std::span<const Spec> more = {});

  Reader& reader() { return reader_; }
  const Plugin& plugin() const { return plugin_; }
  const SourceLocation& where() const { return plugin_.where; }
  /// Of the parameter if it is given, else of the plugin.
  const SourceLocation& where(std::string_view name) const;

  bool has(std::string_view name) const { return given(name) != nullptr; }
  const Parameter* given(std::string_view name) const;

  /// pbrt-v3 looks for a name with a type: a parameter of another type than these is dropped, with
  /// a warning. For what several types are known of, of which the plugin takes some.
  void drop_others_in_v3(std::string_view name, Types types);

  // Each is the preset if the parameter is not given; a parameter without preset is zero or empty.
  double number(std::string_view name);
  int integer(std::string_view name) { return int(number(name)); }
  bool boolean(std::string_view name);
  std::string string(std::string_view name);
  std::array<double, 3> point(std::string_view name);
  std::vector<double> numbers(std::string_view name);
  /// A number that must be greater than zero, or not less; the preset after an error.
  double positive(std::string_view name);
  double not_negative(std::string_view name);
  /// The path of a file that exists, or "".
  std::string file(std::string_view name);

  /// A colour or texture. Constant reflectances must be from 0 to 1.
  ColorInput color_input(std::string_view name, ColorMeaning meaning);
  Spectrum color(std::string_view name, ColorMeaning meaning);
  FloatInput float_input(std::string_view name);
  /// The refractive index of a dielectric: a number, or a spectrum by its mean.
  double index_of_refraction(std::string_view name);

 private:
  const Spec& spec(std::string_view name) const;
  std::string_view preset(std::string_view name) const;
  Spectrum preset_color(std::string_view name) const;
  void check(const Parameter& p);
  /// The texture that the parameter names, among those that are known `of` colours or of numbers.
  /// Null after an error.
  template <class Input>
  const Input* find_texture(const Parameter& p,
                            const std::map<std::string, Input, std::less<>>& known,
                            std::string_view of);
  double read_index(const Parameter* p, std::string_view name);

  Reader& reader_;
  const Plugin& plugin_;
  std::span<const Spec> specs_, more_;
  std::vector<const Parameter*> given_;
};

}  // namespace duet::pbrt
