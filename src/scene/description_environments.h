// Lights that surround the scene, as plain data.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "math/color_matrix.h"
#include "scene/description_base.h"
#include "scene/emission_parameters.h"
#include "scene/light_model.h"

namespace duet {

// Several of them add up, which Mitsuba has no way to say.

/// The same radiance from everywhere.
struct ConstantLight {
  Spectrum radiance{1.0f};
  static constexpr auto fields() {
    return FieldList(field(&ConstantLight::radiance, parameter_words::kRadiance).shown(": "));
  }
  static constexpr const char* name() { return "constant"; }
  static constexpr LightPose kPose = LightPose::none;
  static constexpr bool kIsEnvironment = true;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};

/// How an image covers the sphere of directions around a scene: by latitude and longitude, with the
/// light's +y up; or as a square of equal areas (math/equal_area.h), with what is there +z up here
/// +y, so that both have their poles at the same place.
/// `latitude_longitude` has its first and last row at the poles, `row_centers` half a row away from
/// them, as pbrt-v3 has.
enum class EnvironmentLayout { latitude_longitude, equal_area, row_centers };
inline constexpr std::string_view kEnvironmentLayouts[] = {"latitude and longitude", "equal area",
                                                           "row centers"};
/// An image around the scene.
struct EnvironmentMapLight {
  std::string file;  ///< resolved path
  double scale = 1;
  std::optional<double> gamma;  ///< as in BitmapTexture
  Spectrum tint{1.0f};          ///< multiplies the image as `scale` does
  EnvironmentLayout layout = EnvironmentLayout::latitude_longitude;
  /// The light is scaled so that a plane that faces its +y receives twice this much, multiplied by
  /// `scale` and `tint`.
  std::optional<double> illuminance = std::nullopt;
  std::optional<ColorMatrix> colors = std::nullopt;  ///< as in BitmapTexture
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using L = EnvironmentMapLight;
    return FieldList(
        field(&L::file, Parameter{.name = "filename", .type = file, .required = true})
            .names_data()
            .shown(": "),
        field(&L::scale, Parameter{.name = "scale",
                                   .type = number,
                                   .preset = kInitial,
                                   .range = not_negative,
                                   .aliases = "intensity_scale"})
            .shown(", scale "),
        field(&L::tint).shown_if_changed(", tint "),
        field(&L::layout).words(kEnvironmentLayouts).shown_if_changed(", by "),
        field(&L::illuminance).shown(", illuminance "), field(&L::colors).shown(", colours "),
        field(&L::gamma,
              Parameter{"gamma", number, "(of the file)", "1: linear, -1: sRGB", any, v0})
            .unwritten()
            .shown(", gamma "));
  }
  static constexpr const char* name() { return "envmap"; }
  static constexpr LightPose kPose = LightPose::none;
  static constexpr bool kIsEnvironment = true;
  std::vector<std::string> losses() const;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};

/// A sun whose brightness the file's version decides; the horizon does not cut it.
struct SunDisk {
  std::array<double, 3> direction{0, 0, 1};  ///< to its middle, not zero
  Spectrum irradiance{1.0f};                 ///< on a plane across that direction
  static constexpr auto fields() {
    return FieldList(field(&SunDisk::direction),
                     field(&SunDisk::irradiance).shown(" of irradiance "));
  }
};

/// Hosek and Wilkie's sky with the sun in it; +z is up.
struct SkyLight {
  double turbidity = 3;
  Spectrum albedo{0.3f};
  std::array<double, 3> sun{0, 0, 1};  ///< direction to the sun, not zero
  double sky_scale = 1, sun_scale = 1;
  double sun_aperture = 0.5358;  ///< degrees
  std::optional<SunDisk> disk;   ///< 0.x: instead of Hosek and Wilkie's sun
  double stretch = 1;            ///< 0.x: how far the sky is drawn beyond the horizon
  bool extend = false;           ///< 0.x: the horizon goes on below
  /// How they are read depends on the plugin.
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using L = SkyLight;
    return FieldList(
        field(&L::turbidity, Parameter{"turbidity", number, kInitial, "of the air, from 1 to 10"})
            .shown(" of turbidity "),
        field(&L::albedo, Parameter{.name = "albedo",
                                    .type = reflectance,
                                    .preset = kInitial,
                                    .note = "of the ground",
                                    .preset_0x = "0.2"})
            .shown(", albedo "),
        field(&L::sky_scale,
              Parameter{"sky_scale", number, kInitial,
                        "multiplies the light of the sky; in 0.x instead of scale", not_negative})
            .shown(", scale "),
        field(&L::sun_scale,
              Parameter{"sun_scale", number, kInitial,
                        "multiplies the light of the sun; in 0.x instead of scale", not_negative})
            .shown(", sun "),
        field(&L::sun_aperture, Parameter{"sun_aperture", number, kInitial, "in degrees", any, v3})
            .shown(", aperture "),
        field(&L::sun, Parameter{"sun_direction", point, "", "either this or time and place"})
            .shown(", direction "),
        field(&L::disk).shown(", disk"),
        field(&L::stretch, Parameter{"stretch", number, kInitial,
                                     "draws the sky below the horizon, up to 2", any, v0})
            .unwritten()
            .shown_if_changed(", stretch "),
        field(&L::extend,
              Parameter{"extend", boolean, kInitial, "the horizon goes on below", any, v0})
            .unwritten()
            .shown(", extended below the horizon"));
  }
  static constexpr const char* name() { return "sunsky"; }
  static constexpr LightPose kPose = LightPose::none;
  static constexpr bool kIsEnvironment = true;
  std::vector<std::string> losses() const;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};

/// A rectangle in the world, whatever the light's transform is, by its corners in order: only what
/// leaves the scene through it, along (corners[3] − corners[0]) × (corners[1] − corners[0]), finds
/// the environment. pbrt has it.
struct Portal {
  std::array<std::array<double, 3>, 4> corners{};
  static constexpr auto fields() { return plain_fields(&Portal::corners); }
};

}  // namespace duet
