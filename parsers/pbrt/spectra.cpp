#include "pbrt/spectra.h"

#include <algorithm>
#include <cmath>

#include "pbrt/lexer.h"
#include "pbrt/metals.h"
#include "values/ior.h"
#include "values/spectrum_text.h"

namespace duet::pbrt {

namespace {

constexpr ColorSpace kColorSpaces[] = {
    {"srgb", {{{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {0.3127, 0.329}}}},
    {"dci-p3", {{{0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, {0.3127, 0.329}}}},
    {"rec2020", {{{0.708, 0.292}, {0.17, 0.797}, {0.131, 0.046}, {0.3127, 0.329}}}},
    {"aces2065-1", {{{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}}}},
};

constexpr uint8_t kSrgb = 0;

using Triple = std::array<double, 3>;

Triple operator*(const Matrix3& m, const Triple& v) {
  Triple r{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) r[i] += m[i][j] * v[j];
  return r;
}

Matrix3 inverse(const Matrix3& m) {
  Matrix4 wide;
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) wide[i][j] = m[size_t(i)][j];
  const Matrix4 inverted = wide.inverse().value();
  Matrix3 r;
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) r[size_t(i)][j] = inverted[i][j];
  return r;
}

/// XYZ of luminance 1.
Triple xyz_of(const std::array<double, 2>& xy) {
  return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

}  // namespace

Matrix3 to_xyz(uint8_t color_space) {
  const auto& xy = kColorSpaces[color_space].xy;
  Matrix3 m;
  for (size_t j = 0; j < 3; ++j) {
    const Triple c{xy[j][0], xy[j][1], 1 - xy[j][0] - xy[j][1]};
    for (size_t i = 0; i < 3; ++i) m[i][j] = c[i];
  }
  const Triple scale = inverse(m) * xyz_of(xy[3]);
  for (auto& row : m)
    for (size_t j = 0; j < 3; ++j) row[j] *= scale[j];
  return m;
}

namespace {

/// Chromaticity of daylight: Judd, MacAdam & Wyszecki 1964, as CIE 15 has it. Below 4000 K that of
/// a black body: Kim et al. 2002.
std::array<double, 2> daylight_xy(double kelvin) {
  const double t = kelvin, i = 1e3 / t, i2 = i * i, i3 = i2 * i;
  if (t < 4000) {
    const double x = -0.2661239 * i3 - 0.2343589 * i2 + 0.8776956 * i + 0.179910;
    const double y =
        t < 2222 ? -1.1063814 * x * x * x - 1.34811020 * x * x + 2.18555832 * x - 0.20219683
                 : -0.9549476 * x * x * x - 1.37418593 * x * x + 2.09137015 * x - 0.16748867;
    return {x, y};
  }
  // The temperature counts by a value of Planck's second constant that has changed since.
  const double c = 1.4388 / 1.4380;
  const double j = i / c, j2 = j * j, j3 = j2 * j;
  const double x = t * c <= 7000 ? -4.6070 * j3 + 2.9678 * j2 + 0.09911 * j + 0.244063
                                 : -2.0064 * j3 + 1.9018 * j2 + 0.24748 * j + 0.237040;
  return {x, -3 * x * x + 2.87 * x - 0.275};
}

struct Illuminant {
  std::string_view name;
  std::array<double, 2> xy;
};
/// CIE 15: chromaticities for the 2° observer.
constexpr Illuminant kIlluminants[] = {
    {"stdillum-A", {0.44757, 0.40745}},   {"stdillum-D50", {0.34567, 0.35850}},
    {"stdillum-D65", {0.31272, 0.32903}}, {"stdillum-F1", {0.31310, 0.33727}},
    {"stdillum-F2", {0.37208, 0.37529}},  {"stdillum-F3", {0.40910, 0.39430}},
    {"stdillum-F4", {0.44018, 0.40329}},  {"stdillum-F5", {0.31379, 0.34531}},
    {"stdillum-F6", {0.37790, 0.38835}},  {"stdillum-F7", {0.31292, 0.32933}},
    {"stdillum-F8", {0.34588, 0.35875}},  {"stdillum-F9", {0.37417, 0.37281}},
    {"stdillum-F10", {0.34609, 0.35986}}, {"stdillum-F11", {0.38052, 0.37713}},
    {"stdillum-F12", {0.43695, 0.40441}}, {"illum-acesD60", {0.32168, 0.33767}},
};

struct Glass {
  std::string_view name;
  double index;
};
/// Catalogue values of the helium d line.
constexpr Glass kGlasses[] = {
    {"glass-BK7", 1.5168},    {"glass-BAF10", 1.67003}, {"glass-FK51A", 1.48656},
    {"glass-LASF9", 1.85025}, {"glass-F5", 1.67271},    {"glass-F10", 1.72828},
    {"glass-F11", 1.78472},   {"glass-SF5", 1.67271},   {"glass-SF10", 1.72828},
    {"glass-SF11", 1.78472},
};

/// Brass of 70 % copper, whose spectrum is not at hand: indices that have its colour where light
/// falls on it straight, 0.91, 0.78 and 0.42.
constexpr Metal kBrass{"CuZn", {0.44f, 0.53f, 1.3f}, {4.18f, 2.685f, 1.929f}};

}  // namespace

std::span<const ColorSpace> color_spaces() {
  return kColorSpaces;
}

std::optional<uint8_t> find_color_space(std::string_view name) {
  for (size_t i = 0; i < std::size(kColorSpaces); ++i)
    if (kColorSpaces[i].name == name) return uint8_t(i);
  return std::nullopt;
}

std::optional<uint8_t> find_color_space(std::span<const double, 8> chromaticities) {
  constexpr double kTolerance = 1e-3;
  const auto is_same = [&](const ColorSpace& space) {
    for (size_t i = 0; i < 8; ++i)
      if (std::abs(chromaticities[i] - space.xy[i / 2][i % 2]) > kTolerance) return false;
    return true;
  };
  const auto* found = std::find_if(std::begin(kColorSpaces), std::end(kColorSpaces), is_same);
  if (found == std::end(kColorSpaces)) return std::nullopt;
  return uint8_t(found - kColorSpaces);
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 r{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
  return r;
}

Matrix3 to_linear_srgb(uint8_t color_space) {
  if (color_space == kSrgb) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return inverse(to_xyz(kSrgb)) * to_xyz(color_space);
}

Matrix3 from_linear_srgb(uint8_t color_space) {
  if (color_space == kSrgb) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return inverse(to_xyz(color_space)) * to_xyz(kSrgb);
}

Matrix3 white_balance(double kelvin, uint8_t color_space) {
  const Matrix3 bradford{
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Triple from = bradford * xyz_of(daylight_xy(kelvin));
  const Triple to = bradford * xyz_of(kColorSpaces[color_space].xy[3]);
  Matrix3 scale{};
  for (size_t i = 0; i < 3; ++i) scale[i][i] = to[i] / from[i];
  const Matrix3 in_xyz = inverse(bradford) * scale * bradford;
  return inverse(to_xyz(color_space)) * in_xyz * to_xyz(color_space);
}

Spectrum in_working_space(const Spectrum& srgb, uint8_t working) {
  if (working == kSrgb) return srgb;
  const Triple c = from_linear_srgb(working) * Triple{srgb.r, srgb.g, srgb.b};
  return {float(c[0]), float(c[1]), float(c[2])};
}

Matrix3 between_spaces(uint8_t from, uint8_t to, ColorMeaning meaning) {
  Matrix3 m = from_linear_srgb(to) * to_linear_srgb(from);
  if (meaning == ColorMeaning::emission) return m;
  for (auto& row : m) {
    const double white = row[0] + row[1] + row[2];
    for (double& x : row) x /= white;
  }
  return m;
}

Spectrum color_from_triple(const Parameter& p, ColorMeaning meaning, uint8_t working) {
  const Triple c{p.numbers[0], p.numbers[1], p.numbers[2]};
  Triple rgb = c;
  if (p.type == Type::xyz) {
    rgb = inverse(to_xyz(working)) * c;
  } else if (p.color_space != working) {
    rgb = between_spaces(p.color_space, working, meaning) * c;
    if (meaning == ColorMeaning::reflectance)
      for (double& x : rgb) x = std::clamp(x, 0.0, 1.0);
  }
  return {float(rgb[0]), float(rgb[1]), float(rgb[2])};
}

std::optional<Spectrum> find_illuminant(std::string_view name) {
  for (const Illuminant& i : kIlluminants)
    if (i.name == name) {
      const Triple rgb = inverse(to_xyz(kSrgb)) * xyz_of(i.xy);
      return Spectrum(float(rgb[0]), float(rgb[1]), float(rgb[2]));
    }
  return std::nullopt;
}

std::optional<double> find_glass(std::string_view name) {
  for (const Glass& g : kGlasses)
    if (g.name == name) return g.index;
  return std::nullopt;
}

bool is_brass(std::string_view spectrum) {
  return spectrum == "metal-CuZn-eta" || spectrum == "metal-CuZn-k";
}

std::optional<Spectrum> find_metal(std::string_view name, Version version) {
  const auto part = [&](std::string_view metal, const Spectrum& eta,
                        const Spectrum& k) -> std::optional<Spectrum> {
    if (name == fmt::format("metal-{}-eta", metal)) return eta;
    if (name == fmt::format("metal-{}-k", metal)) return k;
    return std::nullopt;
  };
  for (const Metal& m : measured_metals()) {
    const ConductorEntry* v3 = version == Version::v3 ? find_conductor(m.name) : nullptr;
    if (auto found = v3 ? part(m.name, v3->eta, v3->k) : part(m.name, m.eta, m.k)) return found;
  }
  return part(kBrass.name, kBrass.eta, kBrass.k);
}

std::vector<std::string> spectrum_names() {
  std::vector<std::string> names;
  const auto add = [&](const Metal& metal) {
    for (const char* part : {"eta", "k"})
      names.push_back(fmt::format("metal-{}-{}", metal.name, part));
  };
  for (const Metal& metal : measured_metals()) add(metal);
  add(kBrass);
  for (const Glass& g : kGlasses) names.emplace_back(g.name);
  for (const Illuminant& i : kIlluminants) names.emplace_back(i.name);
  return names;
}

std::optional<std::vector<SpectrumSample>> spectrum_samples(const std::vector<double>& numbers,
                                                            Version version, std::string& why) {
  std::vector<SpectrumSample> samples;
  if (numbers.size() < 2 || numbers.size() % 2 != 0) {
    why =
        fmt::format("a spectrum is pairs of wavelength and value, not {} numbers", numbers.size());
    return std::nullopt;
  }
  for (size_t i = 0; i < numbers.size(); i += 2) samples.push_back({numbers[i], numbers[i + 1]});
  if (version == Version::v3) std::ranges::stable_sort(samples, {}, &SpectrumSample::wavelength);
  const size_t i = first_not_increasing(samples);
  if (i == 0) return samples;
  why = fmt::format("the wavelengths of a spectrum must increase: {} comes after {}",
                    samples[i].wavelength, samples[i - 1].wavelength);
  return std::nullopt;
}

std::vector<SpectrumSample> read_spectrum_file(const std::string& path, Version version) {
  try {
    Lexer in(path);
    std::vector<double> numbers;
    while (in.peek() == Kind::number) in.take_numbers(numbers);
    if (in.peek() != Kind::end)
      throw SyntaxError{in.where(), "a spectrum file holds nothing but numbers"};
    std::string why;
    const auto samples = spectrum_samples(numbers, version, why);
    if (!samples) throw ReadError(path + ": " + why);
    return *samples;
  } catch (const SyntaxError& e) {
    throw ReadError(e.where.to_string() + ": " + e.message);
  }
}

}  // namespace duet::pbrt
