// Integrators as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "math/transform.h"
#include "scene/description_bidirectional.h"

namespace duet {

// What is known of a method stands in its struct, as for textures (description_textures.h).

struct PathIntegratorDescription : PathLimits {
  /// Paths go on from smooth surfaces only: direct light, and what mirrors and glass show of it.
  bool only_specular = false;
  /// So many pixels of a tile, other ones in every sample, use one another's paths from their
  /// second vertices on; 1: each has its own alone.
  int pixel_group = 1;
  static constexpr auto fields() {
    using namespace parameter_words;
    return joined_fields(
        PathLimits::fields(),
        FieldList(field(&PathIntegratorDescription::only_specular,
                        Parameter{"only_specular", boolean, kInitial,
                                  "Duet's own: paths go on from smooth surfaces only"})
                      .unwritten(),
                  field(&PathIntegratorDescription::pixel_group, kPixelGroup).unwritten()));
  }
  static constexpr const char* method_name() { return "path"; }
  std::vector<std::string> losses() const {
    std::vector<std::string> lost = PathLimits::losses();
    if (only_specular) lost.emplace_back("\"only_specular\" does not exist in Mitsuba 3");
    if (pixel_group > 1) lost.emplace_back("\"pixel_group\" does not exist in Mitsuba 3");
    return lost;
  }
};
/// Mitsuba's two names for path tracing through media; Duet has one method for both.
enum class VolumePathName { volpath, volpathmis };
/// Its segments are between points where light is scattered: what passes straight through a surface
/// does not count.
struct VolumePathIntegratorDescription : PathLimits {
  VolumePathName name = VolumePathName::volpath;
  static constexpr auto fields() {
    using namespace parameter_words;
    using D = VolumePathIntegratorDescription;
    return joined_fields(
        limits(max_depth_parameter("longest path in segments; surfaces that light passes straight "
                                   "do not count; -1: no limit")),
        own_fields(), FieldList(field(&D::name)));
  }
  const char* method_name() const {
    return name == VolumePathName::volpath ? "volpath" : "volpathmis";
  }
};
struct DirectIntegratorDescription {
  int emitter_samples = 1, bsdf_samples = 1;
  bool hide_emitters = false, strict_normals = false;
  LightSelection light_selection = LightSelection::automatic;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using D = DirectIntegratorDescription;
    return FieldList(
        field(&D::emitter_samples, Parameter{.name = "emitter_samples",
                                             .type = integer,
                                             .preset = kInitial,
                                             .range = not_negative,
                                             .aliases = "luminaire_samples"})
            .read_by_plugin(),
        field(&D::bsdf_samples, Parameter{"bsdf_samples", integer, kInitial, "", not_negative})
            .read_by_plugin(),
        field(&D::hide_emitters, kHideEmitters),
        field(&D::strict_normals, kStrictNormals0x).unwritten(),
        field(&D::light_selection, kLightSelection).words(kLightSelectionNames).unwritten());
  }
  static constexpr const char* method_name() { return "direct"; }
  std::vector<std::string> losses() const {
    return PathLimits::own_losses(strict_normals, light_selection);
  }
};
struct DepthIntegratorDescription {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* method_name() { return "depth"; }
};

/// Ambient occlusion.
struct OcclusionIntegratorDescription {
  int shading_samples = 1;
  double ray_length = 0;   ///< world units; 0: half the radius of a sphere around the scene
  bool background = true;  ///< the image is white, not black, where the camera sees nothing
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using D = OcclusionIntegratorDescription;
    return FieldList(
        field(&D::shading_samples, Parameter{"shading_samples", integer, kInitial, "", size}),
        field(&D::ray_length, Parameter{"ray_length", number, "-1",
                                        "not above 0: half the radius of a sphere around the "
                                        "scene"}),
        field(&D::background));
  }
  static constexpr const char* method_name() { return "ao"; }
  std::vector<std::string> losses() const {
    std::vector<std::string> lost{"Mitsuba 3 has no integrator \"ao\""};
    if (!background) lost.emplace_back("the background of ambient occlusion is white");
    return lost;
  }
};

/// Whichever method suits the scene.
struct AutoIntegratorDescription : PathLimits {
  static constexpr auto fields() {
    using namespace parameter_words;
    return joined_fields(limits(max_depth_parameter()),
                         FieldList(field(&PathLimits::strict_normals, kStrictNormals),
                                   field(&PathLimits::light_selection, kLightSelection)
                                       .words(kLightSelectionNames)
                                       .terse()));
  }
  static constexpr const char* method_name() { return "auto"; }
  static std::vector<std::string> losses() { return {"only Duet reads the integrator \"auto\""}; }
};

/// Layers by their Mitsuba name and the name they get in the file.
struct AovDescription {
  struct Layer {
    std::string kind, name;
    bool in_frame = false;  ///< as pbrt's gbuffer has them
    static constexpr auto fields() {
      return plain_fields(&Layer::kind, &Layer::name, &Layer::in_frame);
    }
  };
  std::vector<Layer> layers;
  /// From the world to where positions and normals of the layers in a frame are told; their normals
  /// are turned towards the camera. Those of others are the world's, and normals the surface's.
  Matrix4 frame;
  static constexpr auto fields() {
    return plain_fields(&AovDescription::layers, &AovDescription::frame);
  }
};

struct IntegratorDescription {
  SourceLocation where;
  std::variant<PathIntegratorDescription, DirectIntegratorDescription, DepthIntegratorDescription,
               BidirectionalIntegratorDescription, VolumePathIntegratorDescription,
               AutoIntegratorDescription, OcclusionIntegratorDescription>
      method;
  AovDescription aovs;   ///< layers asked for by an `aov` integrator
  bool image = true;     ///< false if an `aov` integrator has no nested integrator
  bool moments = false;  ///< wrapped in a `moment` integrator: second moments as layers
  static constexpr auto fields() {
    return plain_fields(&IntegratorDescription::where, &IntegratorDescription::method,
                        &IntegratorDescription::aovs, &IntegratorDescription::image,
                        &IntegratorDescription::moments);
  }
};

/// By what the method's light samples choose a light; `power`, which costs nothing, if it has none.
inline LightSelection light_selection(const IntegratorDescription& integrator) {
  return std::visit(
      []<class T>(const T& method) {
        if constexpr (std::is_same_v<T, BidirectionalIntegratorDescription>)
          return method.is(BidirectionalMethod::ptracer) ? LightSelection::power
                                                         : method.light_selection;
        else if constexpr (requires { method.light_selection; })
          return method.light_selection;
        else
          return LightSelection::power;
      },
      integrator.method);
}

}  // namespace duet
