// Colours as files give them: numbers, spectra, names.
#include <algorithm>
#include <cmath>

#include "pbrt/reader.h"
#include "pbrt/spectra.h"
#include "scene/texture_texels.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

/// A spectrum that is the same over all that can be seen.
std::optional<double> constant_value(const std::vector<SpectrumSample>& samples) {
  if (samples.empty() || samples.front().wavelength > 380 || samples.back().wavelength < 780)
    return std::nullopt;
  for (const SpectrumSample& s : samples)
    if (s.value != samples.front().value) return std::nullopt;
  return samples.front().value;
}

/// What pbrt-v3 makes of any spectrum when it renders RGB: the colour that it has as light. Its
/// first and last value hold beyond them, and its sum of 471 values stands for an integral over 470
/// nm.
Spectrum color_in_v3(std::vector<SpectrumSample> samples) {
  constexpr double kFirst = 360, kLast = 830;
  if (samples.empty()) return Spectrum(0.0f);
  if (samples.front().wavelength > kFirst)
    samples.insert(samples.begin(), {kFirst, samples.front().value});
  if (samples.back().wavelength < kLast) samples.push_back({kLast, samples.back().value});
  return spectrum_to_rgb(samples, ColorMeaning::emission) * float(470.0 / 471);
}

/// Whether the light is within so few wavelengths that products of colours mean little: an even
/// spectrum of the same integrals of its values and of their squares would be narrower than 100 nm.
bool is_narrow(const std::vector<SpectrumSample>& samples) {
  double sum = 0, squares = 0;
  size_t next = 0;
  for (int wavelength = 380; wavelength <= 780; ++wavelength) {
    while (next < samples.size() && samples[next].wavelength < wavelength) ++next;
    if (next == samples.size()) break;
    const SpectrumSample& b = samples[next];
    double value = b.wavelength == wavelength ? b.value : 0;
    if (next > 0 && b.wavelength > wavelength) {
      const SpectrumSample& a = samples[next - 1];
      const double t = (wavelength - a.wavelength) / (b.wavelength - a.wavelength);
      value = a.value + t * (b.value - a.value);
    }
    sum += value, squares += value * value;
  }
  return sum * sum < 100 * squares;
}

/// Lamps of three narrow bands.
bool is_narrow_illuminant(std::string_view name) {
  return name == "stdillum-F10" || name == "stdillum-F11" || name == "stdillum-F12";
}

}  // namespace

Spectrum Reader::triple_color(const Parameter& p, ColorMeaning meaning) {
  if (version_ == Version::v4 && meaning != ColorMeaning::reflectance && p.type == Type::rgb &&
      std::any_of(p.numbers.begin(), p.numbers.end(), [](double x) { return x < 0; })) {
    report_.error(p.where, "parameter \"{}\" has a negative component", p.name);
    return Spectrum(0.0f);
  }
  const bool bounded = meaning == ColorMeaning::reflectance && p.type == Type::rgb;
  bool outside = false;
  for (const double x : p.numbers) {
    if (!bounded || (x >= 0 && float(x) <= 1)) continue;  // pbrt reads single precision
    outside = true;
    if (version_ == Version::v3) continue;
    report_.error(p.where, "parameter \"{}\": a reflectance is from 0 to 1, not {}", p.name, x);
    return Spectrum(0.0f);
  }
  Spectrum color = color_from_triple(p, meaning, film_color_space);
  if (!outside) return color;
  report_.warning(p.where, "parameter \"{}\": a reflectance is from 0 to 1; negative ones are 0",
                  p.name);
  for (int c = 0; c < 3; ++c) color[c] = std::max(color[c], 0.0f);
  return color;
}

std::optional<ColorMatrix> Reader::image_colors(const std::string& file, ColorMeaning meaning,
                                                const SourceLocation& where) {
  if (file.empty() || version_ == Version::v3) return std::nullopt;
  uint8_t space = 0;
  if (const auto named = image_chromaticities(file)) {
    const auto found = find_color_space(*named);
    if (!found)
      report_.warning(where,
                      "{}: the colours are taken for sRGB, as in pbrt, which has no space with the "
                      "file's chromaticities",
                      file);
    space = found.value_or(0);
  }
  if (space == film_color_space) return std::nullopt;
  return between_spaces(space, film_color_space, meaning);
}

Spectrum Reader::constant_color(const Parameter& p, ColorMeaning meaning) {
  const auto fail = [&](const std::string& why) {
    report_.error(p.where, "parameter \"{}\": {}", p.name, why);
    return Spectrum(0.0f);
  };
  if (p.type == Type::rgb || p.type == Type::xyz) return triple_color(p, meaning);
  if (p.type == Type::blackbody) {
    if (p.numbers[0] <= 0) return fail("a black body has a positive temperature");
    // v3 has a scale behind each temperature.
    const bool scaled = version_ == Version::v3;
    if (p.numbers.size() != (scaled ? 2 : 1))
      return fail(scaled ? "a black body is given by temperature and scale"
                         : "a black body is given by its temperature");
    return black_body(p.numbers[0]) * float(scaled ? p.numbers[1] : 1);
  }
  std::vector<SpectrumSample> samples;
  if (!p.strings.empty()) {
    const std::string& name = p.strings.front();
    if (const auto metal = find_metal(name, version_)) {
      if (is_brass(name)) approximate(p.where, fmt::format("{} by the colour of brass", name));
      return in_working_space(*metal, film_color_space);
    }
    if (const auto glass = find_glass(name)) return Spectrum(float(*glass));
    if (const auto light = find_illuminant(name)) {
      if (is_narrow_illuminant(name))
        approximate(p.where, fmt::format("the narrow bands of {} by their colour", name));
      return in_working_space(*light, film_color_space);
    }
    const std::string path = spectrum_file(name, p.where);
    if (path.empty()) return Spectrum(0.0f);
    try {
      samples = read_spectrum_file(path, version_);
    } catch (const ReadError& e) {
      return fail(e.what());
    }
  } else {
    std::string why;
    auto pairs = spectrum_samples(p.numbers, version_, why);
    if (!pairs) return fail(why);
    samples = std::move(*pairs);
  }
  if (version_ == Version::v3) return in_working_space(color_in_v3(samples), film_color_space);
  if (const auto constant = constant_value(samples))
    return meaning == ColorMeaning::emission
               ? in_working_space(equal_energy_rgb(*constant), film_color_space)
               : Spectrum(float(*constant));
  if (is_narrow(samples))
    approximate(p.where, fmt::format("the narrow spectrum \"{}\" by its colour", p.name));
  return in_working_space(spectrum_to_rgb(samples, meaning), film_color_space);
}

Spectrum Reader::black_body(double kelvin) {
  std::vector<SpectrumSample> samples = blackbody_spectrum(kelvin, 1);
  // By Wien's law the peak may lie outside of what can be seen.
  const double wavelength = 2.8977721e6 / kelvin;
  const double l = wavelength * 1e-9, c = 299792458, k = 1.3806488e-23, h = 6.62606957e-34;
  const double peak =
      2 * h * c * c / (std::pow(l, 5) * std::expm1(h * c / (l * k * kelvin))) * 1e-9;
  for (SpectrumSample& s : samples) s.value /= peak;
  const Spectrum color = version_ == Version::v3 ? color_in_v3(std::move(samples))
                                                 : spectrum_to_rgb(samples, ColorMeaning::emission);
  return in_working_space(color, film_color_space);
}

std::string Reader::spectrum_file(const std::string& name, const SourceLocation& where) {
  const size_t dot = name.rfind('.');
  if (dot != name.npos) return file(name, where);
  report_.error(where, "there is no spectrum {}{}", in_quotes(name),
                did_you_mean(name, spectrum_names()));
  return "";
}

}  // namespace duet::pbrt
