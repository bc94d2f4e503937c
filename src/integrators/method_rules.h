// What can be said about methods from what a scene contains, before anything is rendered.
#pragma once

#include <string>

#include "scene/description_integrators.h"
#include "scene/features.h"

namespace duet {

/// Which ways of making paths come into question.
struct MethodRules {
  bool has_lights = true;
  /// There are lights that no ray finds and surfaces through which no light sample goes, or beams:
  /// some paths can start at the light only.
  bool needs_light_subpaths = false;
  /// Merging is worth its cost for reflections of what mirrors or lenses make of light.
  bool may_merge = false;
  /// All lights are infinitely far away. Only told: nothing follows from it.
  bool far_lights_only = false;
  /// Surfaces that light passes straight are no vertices (Scene::needs_media_vertices()).
  bool skips_passed_surfaces = false;
  bool has_media = false;                ///< there are participating media
  bool has_heterogeneous_media = false;  ///< some whose transmittance has to be estimated

  bool operator==(const MethodRules&) const = default;
};

MethodRules method_rules(const SceneFeatures& features);

/// What in a scene, or of its sensor, not every method can render.
struct SceneLimits {
  bool media = false;             ///< there are participating media
  bool one_way_surfaces = false;  ///< SceneFeatures::one_way_surfaces
  bool connectible = true;        ///< light sub-paths can be connected with the sensor
  bool emissive_media = false;    ///< some of the media emit
  bool skips_masks = false;       ///< SceneFeatures::skips_masks
};

enum class Obstacle { none, media, emissive_media, one_way_surfaces, sensor };

/// What keeps a method from rendering such a scene: the one answer, for the command line and for
/// `auto`.
Obstacle find_obstacle(const SceneLimits& scene,
                       const decltype(IntegratorDescription::method)& method);

/// For people: "light sub-paths are needed (…); merging is not (…)".
std::string describe(const MethodRules& rules);

}  // namespace duet
