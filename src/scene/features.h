// What a scene contains that decides how light travels in it, and so which method suits it.
#pragma once

#include <cstddef>
#include <string>

#include "geometry/shape.h"

namespace duet {

struct MediumDescription;
struct SceneDescription;
struct ShapeDescription;

/// Counts of the things that are used. What an instanced group holds counts once, however often it
/// is placed.
struct SceneFeatures {
  size_t meshes = 0, analytic_shapes = 0, instances = 0;
  size_t triangles = 0, curve_segments = 0;
  double placed_triangles = 0;  ///< with all copies
  Bounds bounds;                ///< of all surfaces, in world space; empty without surfaces

  size_t area_lights = 0, textured_area_lights = 0;
  size_t point_lights = 0, spot_lights = 0, projectors = 0, directional_lights = 0;
  size_t beams = 0;  ///< lights that only sub-paths from them find
  bool constant_environment = false, environment_map = false, sky = false;
  size_t far_lights() const {
    return directional_lights + constant_environment + environment_map + sky;
  }

  /// Materials on surfaces, by how they scatter. One can count several times: smooth plastic is
  /// diffuse and a mirror.
  size_t diffuse = 0;
  size_t rough_reflection = 0, rough_refraction = 0;  ///< microfacets
  size_t mirrors = 0, smooth_glass = 0;               ///< delta distributions
  size_t masks = 0;                                   ///< partly or wholly transparent surfaces
  bool skips_masks = false;                           ///< they are no vertices of paths
  size_t bumps = 0;                                   ///< bump and normal maps
  size_t textures = 0;
  /// Surfaces that light enters but that it cannot be followed through from its source, because
  /// rays see them from outside only: curves of a material that lets light through.
  size_t one_way_surfaces = 0;

  size_t media = 0;                ///< that shapes or sensors name
  size_t heterogeneous_media = 0;  ///< of them, those whose extinction varies in space
  size_t emissive_media = 0;       ///< of them, those that emit
  bool coloured_media = false;     ///< any whose extinction is a colour

  bool depth_of_field = false;  ///< of any sensor
  size_t moving = 0;            ///< shapes, lights and sensors that move
};

/// Whether the shape counts as SceneFeatures::one_way_surfaces.
bool is_one_way(const SceneDescription& scene, const ShapeDescription& shape);

/// A medium around a sensor that extends to infinity, so that nothing of what is infinitely far
/// away gets through it, or null. One within a shape ends there.
const MediumDescription* endless_medium(const SceneDescription& scene);

/// Looks at everything that shapes of the scene refer to. What moves is where it is when the
/// shutter of the first sensor opens.
SceneFeatures scene_features(const SceneDescription& scene);

/// One line for people: "3 meshes (1,204 triangles), 2 area lights, mirrors, …".
std::string describe(const SceneFeatures& features);

}  // namespace duet
