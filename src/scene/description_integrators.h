// Integrators as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "scene/field.h"

namespace duet {

/// What all methods that trace paths of any length share.
struct PathLimits {
  int max_depth = -1;  ///< longest path in segments; −1 is no limit
  int rr_depth = 5;    ///< segments before Russian roulette begins
  bool hide_emitters = false;
  /// Ignore directions that the shading and the geometric normal see on different sides.
  bool strict_normals = false;
  static constexpr auto fields() {
    return plain_fields(&PathLimits::max_depth, &PathLimits::rr_depth, &PathLimits::hide_emitters,
                        &PathLimits::strict_normals);
  }
};
struct PathIntegratorDescription : PathLimits {};
/// Mitsuba's two names for path tracing through media; Duet has one method for both.
enum class VolumePathName { volpath, volpathmis };
/// Its segments are between points where light is scattered: what passes straight through a surface
/// does not count.
struct VolumePathIntegratorDescription : PathLimits {
  VolumePathName name = VolumePathName::volpath;
  static constexpr auto fields() {
    return std::tuple_cat(PathLimits::fields(),
                          plain_fields(&VolumePathIntegratorDescription::name));
  }
};
struct DirectIntegratorDescription {
  int emitter_samples = 1, bsdf_samples = 1;
  bool hide_emitters = false, strict_normals = false;
  static constexpr auto fields() {
    return plain_fields(
        &DirectIntegratorDescription::emitter_samples, &DirectIntegratorDescription::bsdf_samples,
        &DirectIntegratorDescription::hide_emitters, &DirectIntegratorDescription::strict_normals);
  }
};
struct DepthIntegratorDescription {
  static constexpr auto fields() { return std::tuple(); }
};

/// Ambient occlusion.
struct OcclusionIntegratorDescription {
  int shading_samples = 1;
  double ray_length = 0;  ///< world units; 0: half the radius of a sphere around the scene
  bool background = true;  ///< the image is white, not black, where the camera sees nothing
  static constexpr auto fields() {
    return plain_fields(&OcclusionIntegratorDescription::shading_samples,
                        &OcclusionIntegratorDescription::ray_length,
                        &OcclusionIntegratorDescription::background);
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
  static constexpr auto fields() {
    return plain_fields(
        &BidirectionalIntegratorDescription::method, &BidirectionalIntegratorDescription::max_depth,
        &BidirectionalIntegratorDescription::rr_depth,
        &BidirectionalIntegratorDescription::hide_emitters,
        &BidirectionalIntegratorDescription::strict_normals,
        &BidirectionalIntegratorDescription::light_paths,
        &BidirectionalIntegratorDescription::connections,
        &BidirectionalIntegratorDescription::light_image,
        &BidirectionalIntegratorDescription::radius, &BidirectionalIntegratorDescription::alpha,
        &BidirectionalIntegratorDescription::max_eye_depth,
        &BidirectionalIntegratorDescription::max_light_depth,
        &BidirectionalIntegratorDescription::weights,
        &BidirectionalIntegratorDescription::continue_probability,
        &BidirectionalIntegratorDescription::merge_parts);
  }
};

/// Whichever method suits the scene.
struct AutoIntegratorDescription : PathLimits {};

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

}  // namespace duet
