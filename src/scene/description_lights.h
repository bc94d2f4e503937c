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

namespace duet {

/// Radiant intensity in all directions, W/sr.
struct PointLight {
  Spectrum intensity{1.0f};
  bool operator==(const PointLight&) const = default;
};
/// At the origin of its transform, along +z. Angles in degrees from the axis: full intensity within
/// beam_width, none beyond cutoff_angle, linear in the angle between.
struct SpotLight {
  Spectrum intensity{1.0f};
  double cutoff_angle = 20, beam_width = 15;
  std::optional<TextureId> texture;
  bool operator==(const SpotLight&) const = default;
};
/// A pinhole camera turned around: throws the texture through a frustum along +z.
struct ProjectorLight {
  ColorInput irradiance = Spectrum(1.0f);
  double scale = 1;
  double fov = 45;
  FovAxis fov_axis = FovAxis::x;
  bool operator==(const ProjectorLight&) const = default;
};
/// Irradiance on a plane across the direction +z.
struct DirectionalLight {
  Spectrum irradiance{1.0f};
  bool operator==(const DirectionalLight&) const = default;
};
struct ConstantLight {
  Spectrum radiance{1.0f};
  bool operator==(const ConstantLight&) const = default;
};
/// A latitude–longitude image around the scene, +y up.
struct EnvironmentMapLight {
  std::string file;  ///< resolved path
  double scale = 1;
  std::optional<double> gamma;  ///< as in BitmapTexture
  bool operator==(const EnvironmentMapLight&) const = default;
};

/// A sun whose brightness the file's version decides; the horizon does not cut it.
struct SunDisk {
  std::array<double, 3> direction{0, 0, 1};  ///< to its middle, not zero
  Spectrum irradiance{1.0f};                 ///< on a plane across that direction
  bool operator==(const SunDisk&) const = default;
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
  bool operator==(const SkyLight&) const = default;
};
/// A thin beam along +z, in watts.
struct CollimatedLight {
  Spectrum power{1.0f};
  bool operator==(const CollimatedLight&) const = default;
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
  bool operator==(const LightDescription&) const = default;
};

}  // namespace duet
