// The light that media emit.
#include <algorithm>

#include "pbrt/emission.h"
#include "pbrt/media.h"

namespace duet::pbrt {

namespace {

/// One channel per cell, for what multiplies the emission. pbrt takes a number that is given once
/// for a grid of one cell, so that it fades towards the faces of the medium's box.
std::vector<double> emission_scale(Values& v, std::array<int, 3>& size) {
  std::vector<double> scale = v.has("Lescale") ? v.numbers("Lescale") : std::vector<double>{1};
  if (v.has("Lescale")) {
    const auto cells = size_t(size[0]) * size_t(size[1]) * size_t(size[2]);
    if (scale.size() != cells) {
      v.reader().report().error(v.where("Lescale"), "there are {} values for {} cells",
                                scale.size(), cells);
      scale.assign(cells, 0);
    }
  } else {
    size = {1, 1, 1};
  }
  for (double& x : scale) {
    if (x >= 0) continue;
    v.reader().report().error(v.where("Lescale"), "emission must not be negative");
    x = 0;
  }
  return scale;
}

/// "Le", if it is given and not black: nothing says how bright a black spectrum is.
std::optional<Spectrum> emitted(Values& v) {
  const Parameter* p = v.given("Le");
  if (!p || v.reader().constant_color(*p, ColorMeaning::emission).is_black()) return std::nullopt;
  return emitted_color(v, "Le");
}

}  // namespace

std::optional<EmissionDescription> read_constant_emission(Values& v) {
  const std::optional<Spectrum> color = emitted(v);
  if (!color) return std::nullopt;
  EmissionDescription e;
  e.radiance = *color * float(v.not_negative("Lescale"));
  return e;
}

std::optional<EmissionDescription> read_grid_emission(Values& v, const std::array<int, 3>& size) {
  const bool by_temperature = v.has("temperature");
  if (by_temperature && v.has("Le"))
    v.reader().report().error(v.where("Le"), "a medium has either \"Le\" or \"temperature\"");
  const std::optional<Spectrum> color = by_temperature ? Spectrum(1.0f) : emitted(v);
  if (!color) return std::nullopt;
  std::array<int, 3> scale_size = size;
  const std::vector<double> scale = emission_scale(v, scale_size);
  const VolumeId radiance = add_grid(
      v, scale_size, 3, [&](size_t cell, int c) { return float(scale[cell]) * (*color)[c]; });
  if (!by_temperature) {
    EmissionDescription e;
    e.radiance = radiance;
    return e;
  }
  const std::vector<double> kelvin = v.numbers("temperature");
  if (kelvin.size() != size_t(size[0]) * size_t(size[1]) * size_t(size[2])) {
    v.reader().report().error(v.where("temperature"),
                              "density and temperature have different "
                              "numbers of cells");
    return std::nullopt;
  }
  const VolumeId temperature =
      add_grid(v, size, 1, [&](size_t cell, int) { return float(kelvin[cell]); });
  return emission_by_temperature(v, radiance, temperature,
                                 *std::max_element(kelvin.begin(), kelvin.end()));
}

std::optional<EmissionDescription> read_rgb_emission(Values& v, const std::array<int, 3>& size) {
  const Parameter* p = v.given("Le");
  if (!p) return std::nullopt;
  const size_t cells = size_t(size[0]) * size_t(size[1]) * size_t(size[2]);
  if (p->type != Type::rgb || p->numbers.size() != 3 * cells || !v.has("sigma_a")) {
    v.reader().report().error(p->where,
                              "\"Le\" needs rgb numbers for all {} cells, and \"sigma_a\"", cells);
    return std::nullopt;
  }
  const float scale = float(v.not_negative("Lescale")) * kUnscaled;
  EmissionDescription e;
  e.radiance = add_grid(v, size, 3, [&](size_t cell, int c) {
    return std::max(float(p->numbers[3 * cell + size_t(c)]), 0.0f) * scale;
  });
  return e;
}

EmissionDescription emission_by_temperature(Values& v, ColorVolume scale, VolumeId temperature,
                                            double hottest) {
  // Steps that are small beside the changes of a black body's light.
  constexpr int kSteps = 1024;
  constexpr double kColdest = 100;
  EmissionDescription e;
  e.offset = v.number(v.has("temperatureoffset") ? "temperatureoffset" : "temperaturecutoff");
  e.factor = v.number("temperaturescale");
  e.radiance = scale;
  e.temperature = temperature;
  e.hottest = std::max(hottest, 1.0);
  for (int i = 0; i <= kSteps; ++i) {
    const double kelvin = (e.hottest * i / kSteps - e.offset) * e.factor;
    e.colors.push_back(kelvin > kColdest ? v.reader().black_body(kelvin) * kUnscaled
                                         : Spectrum(0.0f));
  }
  return e;
}

}  // namespace duet::pbrt
