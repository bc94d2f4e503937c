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
/// At the origin of its transform, along +z. Angles in degrees from the axis: full intensity within
/// beam_width, none beyond cutoff_angle, linear in the angle between.
struct SpotLight {
  Spectrum intensity{1.0f};
  double cutoff_angle = 20, beam_width = 15;
  std::optional<TextureId> texture;
  static constexpr auto fields() {
    return plain_fields(&SpotLight::intensity, &SpotLight::cutoff_angle, &SpotLight::beam_width,
                        &SpotLight::texture);
  }
};
/// A pinhole camera turned around: throws the texture through a frustum along +z.
struct ProjectorLight {
  ColorInput irradiance = Spectrum(1.0f);
  double scale = 1;
  double fov = 45;
  FovAxis fov_axis = FovAxis::x;
  static constexpr auto fields() {
    return plain_fields(&ProjectorLight::irradiance, &ProjectorLight::scale, &ProjectorLight::fov,
                        &ProjectorLight::fov_axis);
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
/// A latitude–longitude image around the scene, +y up.
struct EnvironmentMapLight {
  std::string file;  ///< resolved path
  double scale = 1;
  std::optional<double> gamma;  ///< as in BitmapTexture
  static constexpr auto fields() {
    return std::tuple_cat(std::tuple(field(&EnvironmentMapLight::file).names_data()),
                          plain_fields(&EnvironmentMapLight::scale, &EnvironmentMapLight::gamma));
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
               EnvironmentMapLight, SkyLight, CollimatedLight>
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
