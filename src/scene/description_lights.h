// Lights that are not surfaces, as plain data.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "math/fov.h"
#include "math/motion.h"
#include "math/transform.h"
#include "scene/description_base.h"
#include "scene/field.h"

namespace duet {

/// Radiant intensity in all directions, W/sr.
struct PointLight {
  Spectrum intensity{1.0f};
  static constexpr auto fields() { return plain_fields(&PointLight::intensity); }
};
/// Between full and no intensity: linear in the angle, or t²(3 − 2t) of the angle's cosine.
enum class SpotFalloff { linear, smooth };
/// At the origin of its transform, along +z. Angles in degrees from the axis: full intensity within
/// beam_width, none beyond cutoff_angle.
struct SpotLight {
  Spectrum intensity{1.0f};
  double cutoff_angle = 20, beam_width = 15;
  std::optional<TextureId> texture;
  SpotFalloff falloff = SpotFalloff::linear;
  static constexpr auto fields() {
    return plain_fields(&SpotLight::intensity, &SpotLight::cutoff_angle, &SpotLight::beam_width,
                        &SpotLight::texture, &SpotLight::falloff);
  }
};
/// A pinhole camera turned around: throws the texture through a frustum along +z.
struct ProjectorLight {
  ColorInput irradiance = Spectrum(1.0f);
  double scale = 1;
  double fov = 45;
  FovAxis fov_axis = FovAxis::x;
  /// The texture is radiant intensity; else it is what falls on a plane, over π.
  bool is_intensity = false;
  static constexpr auto fields() {
    return plain_fields(&ProjectorLight::irradiance, &ProjectorLight::scale, &ProjectorLight::fov,
                        &ProjectorLight::fov_axis, &ProjectorLight::is_intensity);
  }
};
/// Radiant intensity in all directions by an image that is a square of equal areas
/// (math/equal_area.h), without interpolation.
struct GoniometricLight {
  std::string file;  ///< resolved path
  Spectrum scale{1.0f};
  static constexpr auto fields() {
    return std::tuple_cat(std::tuple(field(&GoniometricLight::file).names_data()),
                          plain_fields(&GoniometricLight::scale));
  }
};
/// Irradiance on a plane across the direction +z.
struct DirectionalLight {
  Spectrum irradiance{1.0f};
  static constexpr auto fields() { return plain_fields(&DirectionalLight::irradiance); }
};
struct ConstantLight {
  Spectrum radiance{1.0f};
  static constexpr auto fields() { return plain_fields(&ConstantLight::radiance); }
};
/// How an image covers the sphere of directions around a scene: by latitude and longitude, with the
/// light's +y up; or as a square of equal areas (math/equal_area.h), with what is there +z up here
/// +y, so that both have their poles at the same place.
enum class EnvironmentLayout { latitude_longitude, equal_area };
/// An image around the scene.
struct EnvironmentMapLight {
  std::string file;  ///< resolved path
  double scale = 1;
  Spectrum tint{1.0f};  ///< multiplies the image as `scale` does
  EnvironmentLayout layout = EnvironmentLayout::latitude_longitude;
  /// The light is scaled so that a plane that faces its +y would receive this much, multiplied by
  /// `scale` and `tint`.
  std::optional<double> illuminance;
  std::optional<double> gamma;  ///< as in BitmapTexture
  static constexpr auto fields() {
    return std::tuple_cat(
        std::tuple(field(&EnvironmentMapLight::file).names_data()),
        plain_fields(&EnvironmentMapLight::scale, &EnvironmentMapLight::tint,
                     &EnvironmentMapLight::layout, &EnvironmentMapLight::illuminance,
                     &EnvironmentMapLight::gamma));
  }
};

/// A sun whose brightness the file's version decides; the horizon does not cut it.
struct SunDisk {
  std::array<double, 3> direction{0, 0, 1};  ///< to its middle, not zero
  Spectrum irradiance{1.0f};                 ///< on a plane across that direction
  static constexpr auto fields() { return plain_fields(&SunDisk::direction, &SunDisk::irradiance); }
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
  static constexpr auto fields() {
    return plain_fields(&SkyLight::turbidity, &SkyLight::albedo, &SkyLight::sun,
                        &SkyLight::sky_scale, &SkyLight::sun_scale, &SkyLight::sun_aperture,
                        &SkyLight::disk, &SkyLight::stretch, &SkyLight::extend);
  }
};
/// A thin beam along +z, in watts.
struct CollimatedLight {
  Spectrum power{1.0f};
  static constexpr auto fields() { return plain_fields(&CollimatedLight::power); }
};

struct LightDescription {
  SourceLocation where;
  Label label;
  std::variant<PointLight, SpotLight, ProjectorLight, DirectionalLight, ConstantLight,
               EnvironmentMapLight, SkyLight, CollimatedLight, GoniometricLight>
      model;
  Matrix4 to_world;
  Motion motion;  ///< as in ShapeDescription; environments only turn
  /// Multiplies the light's share in the choice of a light (`sampling_weight`).
  double sampling_weight = 1;
  std::optional<MediumId> medium;  ///< that the light stands in
  static constexpr auto fields() {
    return plain_fields(&LightDescription::where, &LightDescription::label,
                        &LightDescription::model, &LightDescription::to_world,
                        &LightDescription::motion, &LightDescription::sampling_weight,
                        &LightDescription::medium);
  }
};

}  // namespace duet
