// Lights that are not surfaces, as plain data.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "math/motion.h"
#include "math/transform.h"
#include "scene/description_base.h"
#include "scene/emission_parameters.h"
#include "scene/fov_fields.h"
#include "scene/light_model.h"

namespace duet {

// What is known of a light stands in its struct, as for textures (description_textures.h);
// count() counts it among what decides which method suits a scene. Several environments add up,
// which Mitsuba has no way to say.

/// Radiant intensity in all directions, W/sr.
struct PointLight {
  Spectrum intensity{1.0f};
  static constexpr auto fields() {
    return FieldList(field(&PointLight::intensity, parameter_words::kIntensity).shown(": "));
  }
  static constexpr const char* name() { return "point"; }
  static constexpr LightPose kPose = LightPose::place;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};
/// Between full and no intensity: linear in the angle, or t²(3 − 2t) of the angle's cosine.
enum class SpotFalloff { linear, smooth };
inline constexpr std::string_view kSpotFalloffs[] = {"linear", "smooth"};
/// At the origin of its transform, along +z. Angles in degrees from the axis: full intensity within
/// beam_width, none beyond cutoff_angle.
struct SpotLight {
  Spectrum intensity{1.0f};
  double cutoff_angle = 20, beam_width = 15;
  std::optional<TextureId> texture;
  SpotFalloff falloff = SpotFalloff::linear;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using L = SpotLight;
    return FieldList(
        field(&L::intensity, kIntensity).shown(": "),
        field(&L::cutoff_angle, Parameter{"cutoff_angle", number, kInitial,
                                          "no light beyond this angle from the axis", degrees})
            .shown(", cutoff angle "),
        field(&L::beam_width, Parameter{"beam_width", number, "(3/4 cutoff_angle)",
                                        "full intensity within this angle", not_negative})
            .read_by_plugin()
            .shown(", beam width "),
        field(&L::texture, Parameter{"texture", texture, "", "multiplies the intensity"})
            .shown(", texture "),
        field(&L::falloff).words(kSpotFalloffs).shown_if_changed(", falloff "));
  }
  static constexpr const char* name() { return "spot"; }
  static constexpr LightPose kPose = LightPose::both;
  std::vector<std::string> losses() const;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
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
    using namespace parameter_words;
    using enum ParameterType;
    using L = ProjectorLight;
    return joined_fields(FieldList(field(&L::irradiance, kIrradiance).shown(": "),
                                   field(&L::scale, kLightScale).shown(", scale ")),
                         fov_fields(&L::fov, &L::fov_axis, "either this or focal_length"),
                         FieldList(field(&L::is_intensity).shown(", as intensity")));
  }
  static constexpr const char* name() { return "projector"; }
  static constexpr LightPose kPose = LightPose::both;
  std::vector<std::string> losses() const;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};
/// Irradiance on a plane across the direction +z.
struct DirectionalLight {
  Spectrum irradiance{1.0f};
  static constexpr auto fields() {
    return FieldList(
        field(&DirectionalLight::irradiance, parameter_words::kIrradiance).shown(": "));
  }
  static constexpr const char* name() { return "directional"; }
  static constexpr LightPose kPose = LightPose::direction;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};
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
  /// The light is scaled so that a plane that faces its +y would receive this much, multiplied by
  /// `scale` and `tint`.
  std::optional<double> illuminance = std::nullopt;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using L = EnvironmentMapLight;
    return FieldList(field(&L::file, Parameter{.name = "filename", .type = file, .required = true})
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
                     field(&L::illuminance).shown(", illuminance "),
                     field(&L::gamma, Parameter{"gamma", number, "(of the file)",
                                                "1: linear, -1: sRGB", any, v0})
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
/// A thin beam along +z, in watts.
struct CollimatedLight {
  Spectrum power{1.0f};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(
        field(&CollimatedLight::power, Parameter{"power", emission, kInitial, "in watts"})
            .shown(": "));
  }
  static constexpr const char* name() { return "collimated"; }
  static constexpr LightPose kPose = LightPose::both;
  static constexpr bool kOnlyIn0x = true;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
};
/// Radiant intensity in all directions by an image that is a square of equal areas
/// (math/equal_area.h), without interpolation; the mean of its colours counts. pbrt has it.
struct GoniometricLight {
  std::string file;  ///< resolved path
  Spectrum scale{1.0f};
  static constexpr auto fields() {
    using enum ParameterType;
    using L = GoniometricLight;
    return FieldList(field(&L::file, Parameter{.name = "filename", .type = ParameterType::file})
                         .names_data()
                         .shown(": "),
                     field(&L::scale).shown(", scale "));
  }
  static constexpr const char* name() { return "goniometric"; }
  static constexpr LightPose kPose = LightPose::both;
  static constexpr bool kOnlyIn0x = true;
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

struct LightDescription {
  SourceLocation where;
  Label label;
  std::variant<PointLight, SpotLight, ProjectorLight, DirectionalLight, ConstantLight,
               EnvironmentMapLight, SkyLight, CollimatedLight, GoniometricLight, ForeignLight>
      model;
  Matrix4 to_world;
  Motion motion;  ///< as in ShapeDescription; environments only turn
  /// Multiplies the light's share in the choice of a light (`sampling_weight`).
  double sampling_weight = 1;
  std::optional<MediumId> medium;               ///< that the light stands in
  std::optional<Portal> portal = std::nullopt;  ///< of an environment
  static constexpr auto fields() {
    using L = LightDescription;
    return FieldList(field(&L::where), field(&L::label), field(&L::model), field(&L::to_world),
                     field(&L::motion),
                     field(&L::sampling_weight, parameter_words::kSamplingWeight),
                     field(&L::medium), field(&L::portal));
  }
};

/// Whether the light surrounds the scene.
inline bool is_environment(const LightDescription& light) {
  const auto surrounds = []<class T>(const T& model) {
    if constexpr (requires { model.is_environment(); })
      return model.is_environment();
    else
      return requires {
        T::kIsEnvironment;
      };
  };
  return std::visit(surrounds, light.model);
}

}  // namespace duet
