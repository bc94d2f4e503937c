// Sensors, films and samplers as plain data.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/film.h"
#include "image/filter.h"
#include "math/fov.h"
#include "scene/description_shapes.h"

namespace duet {

enum class SensorKind {
  perspective,
  thinlens,
  orthographic,
  telecentric,
  perspective_rdist,
  spherical,
  radiancemeter,
  irradiancemeter,
  fluencemeter,
  distant,
  batch,
};
/// Its name in Mitsuba.
constexpr const char* sensor_name(SensorKind k) {
  constexpr const char* names[] = {
      "perspective",       "thinlens",  "orthographic",  "telecentric",
      "perspective_rdist", "spherical", "radiancemeter", "irradiancemeter",
      "fluencemeter",      "distant",   "batch"};
  return names[size_t(k)];
}
/// Whether points of the scene can be connected with the sensor: Camera::connectible().
constexpr bool is_connectible(SensorKind k) {
  return k == SensorKind::perspective || k == SensorKind::thinlens ||
         k == SensorKind::orthographic || k == SensorKind::perspective_rdist ||
         k == SensorKind::spherical;
}
/// Whether a field of view says what the sensor sees.
constexpr bool has_fov(SensorKind k) {
  return k == SensorKind::perspective || k == SensorKind::thinlens ||
         k == SensorKind::perspective_rdist;
}
/// How a spherical camera's image shows the sphere of directions: by latitude and longitude, or by
/// an octahedron that is folded to a square (math/equal_area.h).
enum class SphereMapping { latitude_longitude, equal_area };
enum class PixelFormat { luminance, luminance_alpha, rgb, rgba, xyz, xyza };
enum class ComponentFormat { half, single };

/// A window of the film in pixels.
struct CropWindow {
  int x = 0, y = 0, width = 0, height = 0;
  static constexpr auto fields() {
    return plain_fields(&CropWindow::x, &CropWindow::y, &CropWindow::width, &CropWindow::height);
  }
};

/// How 0.6's ldrfilm turns radiance into display values. Used for PNG and JPEG output only.
struct ToneMapping {
  bool reinhard = false;
  double gamma = -1;            ///< −1 is the sRGB curve
  double exposure = 0;          ///< in stops
  double key = 0.18, burn = 0;  ///< Reinhard's operator
  static constexpr auto fields() {
    return plain_fields(&ToneMapping::reinhard, &ToneMapping::gamma, &ToneMapping::exposure,
                        &ToneMapping::key, &ToneMapping::burn);
  }
};

struct FilmDescription {
  SourceLocation where;
  int width = 768, height = 576;
  std::optional<CropWindow> crop;
  FilterDescription filter;
  PixelFormat pixel_format = PixelFormat::rgb;
  ComponentFormat component_format = ComponentFormat::half;
  std::optional<ToneMapping> tone_mapping;
  std::optional<FilmResponse> response;
  static constexpr auto fields() {
    return plain_fields(&FilmDescription::where, &FilmDescription::width, &FilmDescription::height,
                        &FilmDescription::crop, &FilmDescription::filter,
                        &FilmDescription::pixel_format, &FilmDescription::component_format,
                        &FilmDescription::tone_mapping, &FilmDescription::response);
  }
};

struct SamplerDescription {
  std::string name = "independent";  ///< as the scene calls it
  int sample_count = 4;
  uint64_t seed = 0;
  static constexpr auto fields() {
    return plain_fields(&SamplerDescription::name, &SamplerDescription::sample_count,
                        &SamplerDescription::seed);
  }
};

struct SensorDescription {
  SourceLocation where;
  Label label;
  SensorKind kind = SensorKind::perspective;
  Matrix4 to_world;  ///< looks along +z, +x to the left of the image, +y up
  Motion motion;     ///< as in ShapeDescription
  /// When the shutter opens and closes, not before. Light is gathered evenly in between.
  std::array<double, 2> shutter{};
  double fov = 45;  ///< degrees
  FovAxis fov_axis = FovAxis::x;
  double principal_point_offset_x = 0, principal_point_offset_y = 0;  ///< in image sizes
  double near_clip = 1e-2, far_clip = 1e4;
  double aperture_radius = 0, focus_distance = 0;  ///< thinlens, telecentric
  std::array<double, 2> distortion{};              ///< perspective_rdist: of r³ and r⁵
  SphereMapping sphere_mapping = SphereMapping::latitude_longitude;  ///< spherical
  uint32_t shape = 0;  ///< irradiancemeter: index in `shapes`
  /// distant: what it averages over; neither is the whole scene.
  std::optional<std::array<double, 3>> target_point;
  std::vector<ShapeDescription> target_shape;  ///< none or one
  std::vector<SensorDescription> parts;        ///< batch; their films and samplers do not count
  std::optional<MediumId> medium;              ///< that the sensor stands in
  FilmDescription film;
  SamplerDescription sampler;
  static constexpr auto fields() {
    return plain_fields(
        &SensorDescription::where, &SensorDescription::label, &SensorDescription::kind,
        &SensorDescription::to_world, &SensorDescription::motion, &SensorDescription::shutter,
        &SensorDescription::fov, &SensorDescription::fov_axis,
        &SensorDescription::principal_point_offset_x, &SensorDescription::principal_point_offset_y,
        &SensorDescription::near_clip, &SensorDescription::far_clip,
        &SensorDescription::aperture_radius, &SensorDescription::focus_distance,
        &SensorDescription::distortion, &SensorDescription::sphere_mapping,
        &SensorDescription::shape, &SensorDescription::target_point,
        &SensorDescription::target_shape, &SensorDescription::parts, &SensorDescription::medium,
        &SensorDescription::film, &SensorDescription::sampler);
  }
};

}  // namespace duet
