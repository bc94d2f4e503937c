// Sensors, films and samplers as plain data.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cameras/lens_system.h"
#include "image/film.h"
#include "image/filter.h"
#include "scene/description_shapes.h"
#include "scene/fov_fields.h"

namespace duet {

enum class SensorKind {
  perspective,
  thinlens,
  orthographic,
  telecentric,
  perspective_rdist,
  spherical,
  realistic,
  radiancemeter,
  irradiancemeter,
  fluencemeter,
  distant,
  batch,
};
/// Its name in Mitsuba.
constexpr const char* sensor_name(SensorKind k) {
  constexpr const char* names[] = {"perspective",  "thinlens",          "orthographic",
                                   "telecentric",  "perspective_rdist", "spherical",
                                   "realistic",    "radiancemeter",     "irradiancemeter",
                                   "fluencemeter", "distant",           "batch"};
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
/// Whether it has a lens, which focuses at one distance.
constexpr bool has_lens(SensorKind k) {
  return k == SensorKind::thinlens || k == SensorKind::telecentric;
}
/// How a spherical camera's image shows the sphere of directions: by latitude and longitude, or by
/// an octahedron that is folded to a square (math/equal_area.h).
enum class SphereMapping { latitude_longitude, equal_area };
inline constexpr std::string_view kSphereMappings[] = {"latitude and longitude", "equal area"};
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
    using namespace parameter_words;
    using enum ParameterType;
    using T = ToneMapping;
    return FieldList(
        field(&T::reinhard, Parameter{"tonemap_method", string, "gamma", "gamma or reinhard"})
            .read_by_plugin()
            .shown(" by Reinhard's operator"),
        field(&T::gamma, Parameter{"gamma", number, kInitial, "-1: sRGB"})
            .shown_if_changed(", gamma "),
        field(&T::exposure, Parameter{"exposure", number, kInitial, "in stops"})
            .shown_if_changed(", exposure "),
        field(&T::key, Parameter{"key", number, kInitial, "of Reinhard's operator", positive})
            .shown_if_changed(", key "),
        field(&T::burn, Parameter{"burn", number, kInitial, "of Reinhard's operator, from 0 to 1",
                                  not_negative})
            .shown_if_changed(", burn "));
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
  std::optional<SampleLimit> sample_limit;

  static constexpr std::string_view kPixelFormats[] = {
      "luminance", "luminance_alpha", "rgb", "rgba", "xyz", "xyza"};
  static constexpr std::string_view kComponentFormats[] = {"float16", "float32"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using F = FilmDescription;
    return FieldList(
        field(&F::where),
        field(&F::width, Parameter{"width", integer, kInitial, "in pixels", size}).read_by_plugin(),
        field(&F::height, Parameter{"height", integer, kInitial, "in pixels", size})
            .read_by_plugin(),
        field(&F::crop, Parameter{"crop_offset_x", integer, "0", "", not_negative},
              Parameter{"crop_offset_y", integer, "0", "", not_negative},
              Parameter{"crop_width", integer, "(width)", "", size},
              Parameter{"crop_height", integer, "(height)", "", size})
            .shown(", window "),
        field(&F::pixel_format, Parameter{"pixel_format", string, kInitial,
                                          "luminance, luminance_alpha, rgb, rgba, xyz, xyza"})
            .words(kPixelFormats)
            .read_by_plugin()
            .shown(", "),
        field(&F::component_format, Parameter{"component_format", string, kInitial,
                                              "float16 or float32; uint32 becomes float32"})
            .words(kComponentFormats)
            .read_by_plugin()
            .shown(" "),
        field(&F::filter).shown(", "), field(&F::tone_mapping).shown(", tone mapping"),
        field(&F::response).shown(", response "),
        field(&F::sample_limit).shown(", samples of at most "));
  }
  std::vector<std::string> losses() const {
    std::vector<std::string> lost;
    if (tone_mapping) lost.emplace_back("the tone mapping of \"ldrfilm\" is missing");
    if (response) lost.emplace_back("the response of a film is missing");
    if (sample_limit) lost.emplace_back("the limit of what a sample may bring is missing");
    return lost;
  }
};

struct SamplerDescription {
  std::string name = "independent";  ///< as the scene calls it
  int sample_count = 4;
  uint64_t seed = 0;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using S = SamplerDescription;
    return FieldList(field(&S::name),
                     field(&S::sample_count,
                           Parameter{"sample_count", integer, kInitial, "per pixel", positive}),
                     field(&S::seed, Parameter{"seed", integer, kInitial, "", not_negative}));
  }
};

/// What a realistic camera looks through. Lengths are those of the camera's space.
struct LensDescription {
  std::vector<LensSurface> surfaces;  ///< from the scene to the film; the last thickness is found
  double focus_distance = 10;         ///< from the film
  double film_diagonal = 0.035;
  StopShape stop = StopShape::disk;
  std::string stop_image;          ///< resolved path, if the stop has the shape of an image
  bool relative_to_pupil = false;  ///< brightness does not depend on the lens (RealisticCamera)
  static constexpr auto fields() {
    using L = LensDescription;
    return FieldList(field(&L::surfaces).shown(", surfaces "),
                     field(&L::focus_distance).shown(", focus at "),
                     field(&L::film_diagonal).shown(", film diagonal "),
                     field(&L::stop).words(kStopShapes).shown(", stop "),
                     field(&L::stop_image).shown_if_changed(" "),
                     field(&L::relative_to_pupil).shown(", relative to the pupil"));
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
  double aperture_aspect = 1;          ///< thinlens: height over width, in the camera's space
  std::array<double, 2> distortion{};  ///< perspective_rdist: of r³ and r⁵
  SphereMapping sphere_mapping = SphereMapping::latitude_longitude;  ///< spherical
  LensDescription lenses;                                            ///< realistic
  uint32_t shape = 0;  ///< irradiancemeter: index in `shapes`
  /// distant: what it averages over; neither is the whole scene.
  std::optional<std::array<double, 3>> target_point;
  std::vector<ShapeDescription> target_shape;  ///< none or one
  std::vector<SensorDescription> parts;        ///< batch; their films and samplers do not count
  std::optional<MediumId> medium;              ///< that the sensor stands in
  FilmDescription film;
  SamplerDescription sampler;

  /// What some kinds of sensors have, and what stands in them.
  static constexpr auto fields_of_kinds() {
    using namespace parameter_words;
    using enum ParameterType;
    using S = SensorDescription;
    constexpr auto pinhole = [](const S& s) { return s.kind == SensorKind::perspective; };
    constexpr auto lens = [](const S& s) { return has_lens(s.kind); };
    return FieldList(
        field(&S::principal_point_offset_x,
              Parameter{"principal_point_offset_x", number, kInitial, "in image widths"})
            .when(pinhole)
            .shown_if_changed(", principal point offset x "),
        field(&S::principal_point_offset_y,
              Parameter{"principal_point_offset_y", number, kInitial, "in image heights"})
            .when(pinhole)
            .shown_if_changed(", principal point offset y "),
        field(&S::aperture_radius, Parameter{"aperture_radius", number, kInitial, "", not_negative})
            .when(lens)
            .shown(", aperture radius "),
        field(&S::aperture_aspect).when(lens).shown_if_changed(", aperture aspect "),
        field(&S::focus_distance,
              Parameter{"focus_distance", number, "(far_clip)", "along the axis", positive})
            .when(lens)
            .read_by_plugin()
            .shown(", focus at "),
        field(&S::distortion,
              Parameter{"kc", string, "0, 0", "radial distortion of third and fifth order"})
            .when([](const S& s) { return s.kind == SensorKind::perspective_rdist; })
            .shown(", distortion "),
        field(&S::sphere_mapping).words(kSphereMappings).shown_if_changed(", by "),
        field(&S::lenses)
            .when([](const S& s) { return s.kind == SensorKind::realistic; })
            .shown(", lenses"),
        field(&S::shape),
        field(&S::target_point, Parameter{"target", point, "(the scene)",
                                          "a point or a shape over which radiance is averaged"})
            .shown(", target "),
        field(&S::target_shape).shown_if_changed(", target "), field(&S::parts),
        field(&S::medium).shown(", in "), field(&S::film), field(&S::sampler));
  }
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using S = SensorDescription;
    constexpr auto clips = [](const S& s) {
      return has_fov(s.kind) || s.kind == SensorKind::orthographic ||
             s.kind == SensorKind::telecentric;
    };
    constexpr auto with_fov = [](const S& s) { return has_fov(s.kind); };
    const auto before_fov = FieldList(
        field(&S::where), field(&S::label), field(&S::kind),
        field(&S::shutter,
              Parameter{"shutter_open", number, "0", "when light is gathered from what moves"},
              Parameter{"shutter_close", number, "0", "not before the shutter opens"})
            .terse()
            .shown_if_changed(", shutter "),
        // One that stands in a shape is where that is.
        field(&S::to_world, Parameter{"to_world", transform}).read_by_plugin().when([](const S& s) {
          return s.kind != SensorKind::irradiancemeter;
        }),
        field(&S::motion),
        field(&S::near_clip, Parameter{"near_clip", number, kInitial, "", positive})
            .when(clips)
            .shown_if_changed(", near clip "),
        field(&S::far_clip, Parameter{"far_clip", number, kInitial, "", positive})
            .when(clips)
            .shown_if_changed(", far clip "));
    const auto fov = fov_fields(&S::fov, &S::fov_axis, "in degrees; either this or focal_length");
    return joined_fields(before_fov, fov.when(with_fov), fields_of_kinds());
  }
  const char* name() const { return sensor_name(kind); }
  std::vector<std::string> losses() const {
    std::vector<std::string> lost;
    if (kind == SensorKind::telecentric || kind == SensorKind::perspective_rdist ||
        kind == SensorKind::spherical || kind == SensorKind::realistic ||
        kind == SensorKind::fluencemeter)
      lost.push_back("the sensor \"" + std::string(name()) + "\" does not exist in Mitsuba 3");
    if (sphere_mapping == SphereMapping::equal_area)
      lost.emplace_back("the image of a spherical camera is one by latitude and longitude");
    if (aperture_aspect != 1)
      lost.emplace_back("the lens of the camera is stretched with its pixels");
    return lost;
  }
};

}  // namespace duet
