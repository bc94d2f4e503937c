// Integrators as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "lights/light_selection.h"
#include "scene/field.h"

namespace duet {

namespace parameter_words {
inline constexpr Parameter kRrDepth{"rr_depth", integer, kInitial, "where Russian roulette begins",
                                    positive};
inline constexpr Parameter kHideEmitters{"hide_emitters", boolean, kInitial,
                                         "lights cannot be seen directly"};
inline constexpr Parameter kStrictNormals{
    "strict_normals", boolean, kInitial, "drop paths whose shading and geometric normals disagree"};
/// Of methods that Mitsuba 3 has, too, but without it.
inline constexpr Parameter kStrictNormals0x{
    "strict_normals",
    boolean,
    kInitial,
    "drop paths whose shading and geometric normals disagree",
    any,
    v0};
inline constexpr Parameter kLightSelection{
    "light_selection", string, kInitial,
    "by what light samples choose a light: auto, bvh, power or uniform (docs/lights.md)"};
constexpr Parameter max_depth_parameter(
    std::string_view note = "longest path in segments; -1: no limit") {
  return {"max_depth", integer, kInitial, note, depth};
}
}  // namespace parameter_words

// What is known of a method stands in its struct, as for textures (description_textures.h).

/// What all methods that trace paths of any length share.
struct PathLimits {
  int max_depth = -1;  ///< longest path in segments; −1 is no limit
  int rr_depth = 5;    ///< segments before Russian roulette begins
  bool hide_emitters = false;
  /// Ignore directions that the shading and the geometric normal see on different sides.
  bool strict_normals = false;
  LightSelection light_selection = LightSelection::automatic;

  static constexpr auto limits(const Parameter& max_depth) {
    using namespace parameter_words;
    using L = PathLimits;
    return FieldList(field(&L::max_depth, max_depth), field(&L::rr_depth, kRrDepth),
                     field(&L::hide_emitters, kHideEmitters));
  }
  /// What Mitsuba 3 does not have.
  static constexpr auto own_fields() {
    using namespace parameter_words;
    using L = PathLimits;
    return FieldList(
        field(&L::strict_normals, kStrictNormals0x).unwritten(),
        field(&L::light_selection, kLightSelection).words(kLightSelectionNames).unwritten());
  }
  static constexpr auto fields() {
    return joined_fields(limits(parameter_words::max_depth_parameter()), own_fields());
  }
  std::vector<std::string> losses() const { return own_losses(strict_normals, light_selection); }
  static std::vector<std::string> own_losses(bool strict, LightSelection selection) {
    std::vector<std::string> lost;
    if (strict) lost.emplace_back("\"strict_normals\" does not exist in Mitsuba 3");
    if (selection != LightSelection::automatic)
      lost.emplace_back("\"light_selection\" does not exist in Mitsuba 3");
    return lost;
  }
};
struct PathIntegratorDescription : PathLimits {
  /// Paths go on from smooth surfaces only: direct light, and what mirrors and glass show of it.
  bool only_specular = false;
  static constexpr auto fields() {
    using namespace parameter_words;
    return joined_fields(
        PathLimits::fields(),
        FieldList(field(&PathIntegratorDescription::only_specular,
                        Parameter{"only_specular", boolean, kInitial,
                                  "Duet's own: paths go on from smooth surfaces only"})
                      .unwritten()));
  }
  static constexpr const char* method_name() { return "path"; }
  std::vector<std::string> losses() const {
    std::vector<std::string> lost = PathLimits::losses();
    if (only_specular) lost.emplace_back("\"only_specular\" does not exist in Mitsuba 3");
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

/// Methods that trace sub-paths from the lights, too.
enum class BidirectionalMethod { ptracer, bdpt, reuse, ppm, bpm, vcm };
/// How `reuse` weights its techniques: exactly, or as the thesis does (docs/mis.md), in
/// either of two readings of it.
enum class ReuseWeights { exact, thesis_a, thesis_b };
struct BidirectionalIntegratorDescription {
  BidirectionalMethod method = BidirectionalMethod::bdpt;
  /// In segments; −1 is no limit, but max_eye_depth + max_light_depth + 1 with the thesis' weights.
  int max_depth = -1;
  int rr_depth = 5;
  bool hide_emitters = false, strict_normals = false;
  LightSelection light_selection = LightSelection::automatic;
  double light_paths = 0;  ///< light sub-paths per pixel; 0: the default of the method
  /// Light vertices to which each eye vertex is connected; −1: all of one light sub-path.
  int connections = -1;
  bool light_image = true;  ///< bdpt: connect light vertices to the camera
  double radius = 0;  ///< of merging in the first iteration, world units; 0: from the pixels' size
  double alpha = 0;   ///< how fast the radius shrinks; 0: the method's default
  int max_eye_depth = 4, max_light_depth = 3;  ///< reuse
  ReuseWeights weights = ReuseWeights::exact;  ///< reuse
  double continue_probability = 1;             ///< reuse
  /// vcm: the parts of the image in which it merges (transport/merge_mask.h), as chosen by `auto`;
  /// empty: all of it.
  std::vector<uint8_t> merge_parts = {};

  static constexpr std::string_view kMethods[] = {"ptracer", "bdpt", "reuse", "ppm", "bpm", "vcm"};
  static constexpr std::string_view kWeights[] = {"exact", "thesis", "thesis"},
                                    kReadings[] = {"b", "a", "b"};
  bool is(BidirectionalMethod m) const { return method == m; }
  bool connects() const { return is(BidirectionalMethod::bdpt) || is(BidirectionalMethod::vcm); }
  bool merges() const { return method >= BidirectionalMethod::ppm; }

  /// What only `reuse` has.
  static constexpr auto reuse_fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using D = BidirectionalIntegratorDescription;
    constexpr auto reuses = [](const D& d) { return d.is(BidirectionalMethod::reuse); };
    return FieldList(
        field(&D::max_eye_depth, Parameter{"max_eye_depth", integer, kInitial,
                                           "longest eye sub-path in segments", not_negative})
            .when(reuses),
        field(&D::max_light_depth, Parameter{"max_light_depth", integer, kInitial,
                                             "longest light sub-path in segments", not_negative})
            .when(reuses),
        field(&D::weights, Parameter{"weights", string, kInitial,
                                     "exact, or those of the thesis, which are biased "
                                     "(docs/mis.md)"})
            .words(kWeights)
            .read_by_plugin()
            .when(reuses),
        field(&D::weights, Parameter{"thesis_reading", string, kInitial,
                                     "a or b, what the weights of the thesis are taken to mean"})
            .words(kReadings)
            .read_by_plugin()
            .when([](const D& d) {
              return d.is(BidirectionalMethod::reuse) && d.weights != ReuseWeights::exact;
            }),
        field(&D::continue_probability,
              Parameter{"continue_probability", number, kInitial,
                        "that an eye sub-path goes on beyond its limit", probability})
            .when(reuses));
  }
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using D = BidirectionalIntegratorDescription;
    using enum BidirectionalMethod;
    constexpr auto merging = [](const D& d) { return d.merges(); };
    return joined_fields(
        FieldList(
            field(&D::method), field(&D::max_depth, max_depth_parameter()),
            field(&D::rr_depth, kRrDepth), field(&D::hide_emitters, kHideEmitters),
            field(&D::strict_normals, kStrictNormals).when([](const D& d) {
              return !d.is(ptracer);
            }),
            field(&D::light_selection, kLightSelection)
                .words(kLightSelectionNames)
                .terse()
                .when([](const D& d) { return !d.is(ptracer); }),
            field(&D::light_paths,
                  Parameter{
                      "light_paths", number, kInitial,
                      "light sub-paths for each pixel; 0: 1/4 for bdpt and vcm, 1 for the others",
                      not_negative})
                .when([](const D& d) { return !d.is(ptracer) || d.light_paths != 0; }),
            field(&D::connections,
                  Parameter{"connections", integer, kInitial,
                            "light vertices for each eye vertex; -1: those of one light sub-path",
                            depth})
                .when([](const D& d) { return d.connects(); }),
            field(&D::light_image, Parameter{"light_image", boolean, kInitial,
                                             "connect light vertices to the camera"})
                .when([](const D& d) { return d.is(bdpt); }),
            field(&D::radius,
                  Parameter{.name = "radius",
                            .type = number,
                            .preset = kInitial,
                            .note = "of merging in the first iteration, in world units; 0: "
                                    "from the size of a pixel",
                            .range = not_negative,
                            .aliases = "initial_radius"})
                .when(merging),
            field(&D::alpha,
                  Parameter{"alpha", number, kInitial,
                            "how fast the radius shrinks; 0: the method's default", fraction})
                .when(merging),
            field(&D::merge_parts)),
        reuse_fields());
  }
  std::string_view method_name() const { return kMethods[size_t(method)]; }
  std::vector<std::string> losses() const {
    if (!is(BidirectionalMethod::ptracer))
      return {"only Duet reads the integrator \"" + std::string(method_name()) + "\""};
    if (light_paths == 0) return {};
    return {"only Duet reads \"light_paths\" of the integrator \"ptracer\""};
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
    static constexpr auto fields() { return plain_fields(&Layer::kind, &Layer::name); }
  };
  std::vector<Layer> layers;
  static constexpr auto fields() { return plain_fields(&AovDescription::layers); }
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
