// Cameras of real lenses.
#include <algorithm>
#include <filesystem>

#include "mesh/byte_reader.h"
#include "pbrt/camera.h"
#include "pbrt/lexer.h"

namespace duet::pbrt {

namespace {

/// Lens files and apertures are in millimetres, scenes in metres.
constexpr double kMillimetre = 1e-3;

/// The numbers in a lens file; none after an error.
std::vector<double> lens_numbers(Report& report, const std::string& path,
                                 const SourceLocation& where) {
  constexpr uintmax_t kLargest = 1 << 20;
  std::error_code failed;
  if (std::filesystem::file_size(path, failed) > kLargest || failed) {
    report.error(where, "{} is not a lens file", path);
    return {};
  }
  std::vector<double> numbers;
  try {
    Lexer lexer(path);
    while (lexer.peek() == Kind::number) lexer.take_numbers(numbers);
    if (lexer.peek() == Kind::end) {
      if (!numbers.empty() && numbers.size() % 4 == 0) return numbers;
      report.error(lexer.where(),
                   "a lens file has four numbers per surface (radius, thickness, refractive index, "
                   "diameter), not {} in all",
                   numbers.size());
    } else {
      report.error(lexer.where(), "a lens file holds nothing but numbers and comments");
    }
  } catch (const SyntaxError& e) {
    report.error(e.where, "{}", e.message);
  } catch (const ReadError& e) {
    report.error(where, "{}", e.what());
  }
  return {};
}

/// The surfaces of a lens file, from the scene to the film, in metres; none after an error.
std::vector<LensSurface> read_lenses(Report& report, const std::string& path,
                                     const SourceLocation& where) {
  const std::vector<double> numbers = lens_numbers(report, path, where);
  std::vector<LensSurface> surfaces;
  const SourceLocation file{std::make_shared<const std::string>(path), 0, 0};
  for (size_t i = 0; i < numbers.size(); i += 4) {
    // An index of 0 stands for air, too.
    const double ior = numbers[i + 2] == 0 ? 1 : numbers[i + 2], diameter = numbers[i + 3];
    const size_t number = surfaces.size() + 1;
    if (!(diameter > 0)) report.error(file, "surface {} has the diameter {}", number, diameter);
    if (!(ior >= 1)) report.error(file, "surface {} has the refractive index {}", number, ior);
    surfaces.push_back({kMillimetre * numbers[i], kMillimetre * numbers[i + 1], ior,
                        kMillimetre * 0.5 * diameter});
  }
  if (!surfaces.empty() && surfaces.back().ior != 1)
    report.error(file, "there must be air behind the last surface, not an index of {}",
                 surfaces.back().ior);
  if (report.has_errors()) surfaces.clear();
  return surfaces;
}

/// Opens the stops as far as the camera says.
void set_stop(Values& v, std::vector<LensSurface>& surfaces) {
  Report& report = v.reader().report();
  const double wanted = kMillimetre * 0.5 * v.positive("aperturediameter");
  bool has_stop = false;
  for (LensSurface& s : surfaces) {
    if (s.radius != 0) continue;
    has_stop = true;
    if (wanted > s.aperture)
      report.warning(v.where("aperturediameter"),
                     "the lens's stop opens to {:g} mm at most, not {:g}",
                     2 * s.aperture / kMillimetre, 2 * wanted / kMillimetre);
    s.aperture = std::min(s.aperture, wanted);
  }
  if (!has_stop && !surfaces.empty())
    report.warning(v.where("lensfile"),
                   "the lens file has no stop (a surface of radius 0): \"aperturediameter\" and "
                   "\"aperture\" have no effect");
}

void read_stop_shape(Values& v, LensDescription& lenses) {
  if (!v.has("aperture")) return;
  const std::string name = v.string("aperture");
  for (const StopShape s :
       {StopShape::gaussian, StopShape::square, StopShape::pentagon, StopShape::star})
    if (name == kStopShapes[size_t(s)]) {
      lenses.stop = s;
      return;
    }
  lenses.stop_image = v.file("aperture");
  if (!lenses.stop_image.empty()) lenses.stop = StopShape::image;
}

}  // namespace

void read_realistic(Values& v, SensorDescription& sensor) {
  sensor.kind = SensorKind::realistic;
  LensDescription& lenses = sensor.lenses;
  lenses.focus_distance = v.positive("focusdistance");
  if (!v.has("lensfile"))
    v.reader().report().error(v.where(), "\"string lensfile\" is needed");
  else if (const std::string path = v.file("lensfile"); !path.empty())
    lenses.surfaces = read_lenses(v.reader().report(), path, v.where("lensfile"));
  set_stop(v, lenses.surfaces);
  if (v.reader().version() == Version::v4) {
    read_stop_shape(v, lenses);
  } else if (v.boolean("simpleweighting")) {
    lenses.relative_to_pupil = true;
  } else {
    // The irradiance counts as long as the shutter is open.
    const double time = v.number("shutterclose") - v.number("shutteropen");
    FilmResponse scaled =
        sensor.film.response.value_or(FilmResponse{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    for (auto& row : scaled)
      for (double& x : row) x *= time;
    if (time != 1) sensor.film.response = scaled;
  }
  place_camera(sensor, v.reader(), Matrix4::scale(-1, 1, 1));
}

}  // namespace duet::pbrt
