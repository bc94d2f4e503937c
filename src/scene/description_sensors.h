// Sensors, films and samplers as plain data.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

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
/// Whether points of the scene can be joined with the sensor: Camera::connectible().
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
enum class PixelFormat { luminance, luminance_alpha, rgb, rgba, xyz, xyza };
enum class ComponentFormat { half, single };

/// A window of the film in pixels.
struct CropWindow {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const CropWindow&) const = default;
};

/// How 0.6's ldrfilm turns radiance into display values. Used for PNG and JPEG output only.
struct ToneMapping {
  bool reinhard = false;
  double gamma = -1;            ///< −1 is the sRGB curve
  double exposure = 0;          ///< in stops
  double key = 0.18, burn = 0;  ///< Reinhard's operator
  bool operator==(const ToneMapping&) const = default;
};

struct FilmDescription {
  SourceLocation where;
  int width = 768, height = 576;
  std::optional<CropWindow> crop;
  FilterDescription filter;
  PixelFormat pixel_format = PixelFormat::rgb;
  ComponentFormat component_format = ComponentFormat::half;
  std::optional<ToneMapping> tone_mapping;
  bool operator==(const FilmDescription&) const = default;
};

struct SamplerDescription {
  std::string name = "independent";  ///< as the scene calls it
  int sample_count = 4;
  uint64_t seed = 0;
  bool operator==(const SamplerDescription&) const = default;
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
  uint32_t shape = 0;                              ///< irradiancemeter: index in `shapes`
  /// distant: what it averages over; neither is the whole scene.
  std::optional<std::array<double, 3>> target_point;
  std::vector<ShapeDescription> target_shape;  ///< none or one
  std::vector<SensorDescription> parts;        ///< batch; their films and samplers do not count
  std::optional<MediumId> medium;              ///< that the sensor stands in
  FilmDescription film;
  SamplerDescription sampler;
  bool operator==(const SensorDescription&) const = default;
};

}  // namespace duet
