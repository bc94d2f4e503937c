// Lights that are not surfaces, as plain data.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lights/spot_falloff.h"
#include "math/motion.h"
#include "math/transform.h"
#include "scene/description_base.h"
#include "scene/description_environments.h"
#include "scene/emission_parameters.h"
#include "scene/fov_fields.h"
#include "scene/light_model.h"

namespace duet {

// What is known of a light stands in its struct, as for textures (description_textures.h);
// count() counts it among what decides which method suits a scene.

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
/// (math/equal_area.h), without interpolation; the mean of its colours counts. pbrt-v4 has it. That
/// of pbrt-v3 has colours by latitude and longitude around +z, with interpolation between them.
struct GoniometricLight {
  std::string file;  ///< resolved path
  Spectrum scale{1.0f};
  bool latitude_longitude = false;
  static constexpr auto fields() {
    using enum ParameterType;
    using L = GoniometricLight;
    return FieldList(field(&L::file, Parameter{.name = "filename", .type = ParameterType::file})
                         .names_data()
                         .shown(": "),
                     field(&L::scale).shown(", scale "), field(&L::latitude_longitude));
  }
  static constexpr const char* name() { return "goniometric"; }
  static constexpr LightPose kPose = LightPose::both;
  static constexpr bool kOnlyIn0x = true;
  void count(SceneFeatures& f) const;
  LightPointer build(SceneBuilder& b, const LightDescription& d) const;
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
