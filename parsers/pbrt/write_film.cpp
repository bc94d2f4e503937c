// The film as pbrt-v4 writes it, with its filter and the samples.
#include <algorithm>
#include <cmath>

#include "pbrt/scene_writer.h"
#include "pbrt/spectra.h"

namespace duet::pbrt {

namespace {

Matrix3 scaled(Matrix3 m, double factor) {
  for (auto& row : m)
    for (double& x : row) x *= factor;
  return m;
}

bool is_close(const Matrix3& a, const Matrix3& b) {
  double largest = 0, difference = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k) {
      largest = std::max(largest, std::abs(b[i][k]));
      difference = std::max(difference, std::abs(a[i][k] - b[i][k]));
    }
  return difference <= 1e-9 * largest;
}

struct Exposure {
  double scale = 1;
  double kelvin = 0;  ///< of white balance; 0: none
};

/// Of which exposure and white balance the response is; nothing if it is not of any.
std::optional<Exposure> exposure_of(const FilmResponse& response) {
  const auto fits = [&](double kelvin) -> std::optional<Exposure> {
    const Matrix3 white =
        kelvin > 0 ? white_balance(kelvin, 0) : Matrix3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double scale = response[1][1] / white[1][1];
    if (!is_close(scaled(white, scale), response)) return std::nullopt;
    return Exposure{scale, kelvin};
  };
  if (const auto plain = fits(0)) return plain;
  // Within each formula for the colour of light, the warmer it is, the more blue its balance adds.
  const double wanted = response[2][2] / response[0][0];
  for (const auto& [first, last] : {std::pair(1000.0, 2222.0), std::pair(2222.0, 4000.0),
                                    std::pair(4000.0, 6996.0), std::pair(6996.0, 25000.0)}) {
    double low = first, high = last;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      const Matrix3 white = white_balance(middle, 0);
      (white[2][2] / white[0][0] > wanted ? low : high) = middle;
    }
    for (const double kelvin : {std::round(low), low, high})
      if (const auto found = fits(kelvin)) return found;
  }
  return std::nullopt;
}

}  // namespace

void SceneWriter::response(Statement& film, const FilmDescription& f, double exposure_time) {
  Exposure exposure;
  if (f.response) {
    const auto found = exposure_of(*f.response);
    if (!found) lose("what the film makes of colours is missing, but for its exposure");
    exposure = found.value_or(Exposure{(*f.response)[1][1], 0});
  }
  if (const double iso = 100 * exposure.scale / exposure_time; iso != 100) film.number("iso", iso);
  if (exposure.kelvin > 0) film.number("whitebalance", exposure.kelvin);
  if (!f.sample_limit) return;
  // pbrt cuts off by the XYZ of samples after the exposure.
  const Matrix3 xyz = to_xyz(0);
  const double factor = f.sample_limit->sensor[1][1] / xyz[1][1];
  if (is_close(f.sample_limit->sensor, scaled(xyz, factor)))
    film.number("maxcomponentvalue", f.sample_limit->most * exposure.scale / factor);
  else
    lose("the limit of what a sample may bring is missing: pbrt-v4 has none by luminance alone");
}

void SceneWriter::film(const SensorDescription& s, double exposure_time) {
  const FilmDescription& f = s.film;
  Statement film("Film", "rgb");
  film.integer("xresolution", f.width).integer("yresolution", f.height);
  film.boolean("savefp16", f.component_format == ComponentFormat::half);
  if (f.crop)
    film.list<int>(
        "pixelbounds", Type::integer,
        std::array{f.crop->x, f.crop->x + f.crop->width, f.crop->y, f.crop->y + f.crop->height});
  response(film, f, exposure_time);
  if (f.pixel_format != PixelFormat::rgb) lose("the film has the channels R, G and B");
  if (f.tone_mapping) lose("the tone mapping of \"ldrfilm\" is missing");
  head_text_ += film.text();
}

void SceneWriter::filter(const FilterDescription& f) {
  using enum FilterKind;
  constexpr std::string_view names[] = {"box",      "triangle", "gaussian",
                                        "mitchell", "mitchell", "sinc"};
  const double radius = filter_radius(f);
  Statement s("PixelFilter", names[size_t(f.kind)]);
  s.number("xradius", f.reach_x.value_or(radius)).number("yradius", f.reach_y.value_or(radius));
  if (f.kind == gaussian) s.number("sigma", f.stddev);
  if (f.kind == mitchell) s.number("B", f.b).number("C", f.c);
  if (f.kind == catmullrom) s.number("B", 0).number("C", 0.5);
  if (f.kind == lanczos) s.number("tau", f.lobes);
  head_text_ += s.text();
}

void SceneWriter::sampler(const SamplerDescription& s) {
  constexpr std::string_view known[] = {"zsobol", "paddedsobol", "sobol",
                                        "halton", "independent", "pmj02bn"};
  const bool is_known = std::find(std::begin(known), std::end(known), s.name) != std::end(known);
  if (!is_known) lose(fmt::format("the sampler \"{}\" is \"zsobol\" instead", s.name));
  head_text_ += Statement("Sampler", is_known ? s.name : "zsobol")
                    .integer("pixelsamples", s.sample_count)
                    .text();
}

}  // namespace duet::pbrt
