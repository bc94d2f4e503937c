// Colours of pbrt files as linear sRGB.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/color_matrix.h"
#include "math/transform.h"
#include "pbrt/parameter.h"
#include "values/color.h"

namespace duet::pbrt {

/// RGB colour spaces by the number that Parameter::color_space has.
struct ColorSpace {
  std::string_view name;
  std::array<std::array<double, 2>, 4> xy;  ///< chromaticities of red, green, blue and white
};
std::span<const ColorSpace> color_spaces();
std::optional<uint8_t> find_color_space(std::string_view name);

using Matrix3 = ColorMatrix;
Matrix3 operator*(const Matrix3& a, const Matrix3& b);
/// From a colour space to CIE XYZ, with luminance one for its white: the columns are its primaries.
Matrix3 to_xyz(uint8_t color_space);
/// From a colour space to linear sRGB, without adaptation to another white.
Matrix3 to_linear_srgb(uint8_t color_space);
/// From linear sRGB to a colour space.
Matrix3 from_linear_srgb(uint8_t color_space);
/// What makes light of the colour of daylight of `kelvin` white (CIE D series; below 4000 K a black
/// body), by von Kries' rule in the cones' responses of Bradford.
/// For colours of that space.
Matrix3 white_balance(double kelvin, uint8_t color_space);

/// From one colour space to another. A reflectance of one has no colour in either, whatever their
/// whites; light has the chromaticity that it had.
Matrix3 between_spaces(uint8_t from, uint8_t to, ColorMeaning meaning);
/// The space with these chromaticities of red, green, blue and white, x before y; nothing if it is
/// none of color_spaces().
std::optional<uint8_t> find_color_space(std::span<const double, 8> chromaticities);
/// A colour that a file gives by RGB or XYZ numbers, in the colour space `working`.
Spectrum color_from_triple(const Parameter& p, ColorMeaning meaning, uint8_t working);
/// From linear sRGB to the colour space `working`.
Spectrum in_working_space(const Spectrum& srgb, uint8_t working);

/// Light of luminance 1 of the chromaticity that a named illuminant has ("stdillum-D65" …).
std::optional<Spectrum> find_illuminant(std::string_view name);
/// The refractive index of a named glass at 587.6 nm.
std::optional<double> find_glass(std::string_view name);
/// What a name like "metal-Cu-eta" stands for: the real or imaginary part of a metal's index. In v3
/// it is what RGB rendering of pbrt-v3 makes of the spectrum, in v4 what has the metal's colour.
std::optional<Spectrum> find_metal(std::string_view name, Version version);
/// Whether it is the index of a metal that is known by its colour alone.
bool is_brass(std::string_view spectrum);
std::vector<std::string> spectrum_names();

/// The pairs of a parameter, which v3 sorts; nothing, with a message, if they are none.
std::optional<std::vector<SpectrumSample>> spectrum_samples(const std::vector<double>& numbers,
                                                            Version version, std::string& why);
/// The pairs in a file of text, with `#` before comments. Throws ReadError.
std::vector<SpectrumSample> read_spectrum_file(const std::string& path, Version version);

}  // namespace duet::pbrt
