// The scene as it is rendered: immutable once built, except that one that moves is posed for every
// sample by the one render that holds its MotionLease.
#pragma once

#include <memory>
#include <vector>

#include "cameras/camera.h"
#include "geometry/accel.h"
#include "geometry/surface.h"
#include "lights/direct_picker.h"
#include "lights/light.h"
#include "materials/material.h"
#include "media/medium.h"
#include "scene/features.h"
#include "textures/texture.h"

namespace duet {

class SceneMotion;

/// Where the light sub-paths of a light begin.
struct LightMedium {
  const Medium* medium = nullptr;  ///< or null for vacuum
  bool depends_on_point = false;   ///< the light may lie in several media: `medium` is not known
  Point3f boundary_point{0};       ///< of a surface between them, if so
};

/// Everything that rays can meet. Owns its parts; indices in shapes refer to these arrays.
struct Scene {
  std::vector<Shape> shapes;
  ShapeRange top;
  std::vector<ShapeRange> groups;
  std::vector<Instance> instances;
  std::vector<std::unique_ptr<Texture>> textures;
  std::vector<std::unique_ptr<Material>> materials;
  std::vector<std::unique_ptr<Light>> lights;
  LightPicker emission_picker;  ///< the light that a light sub-path begins at
  DirectPicker direct_picker;   ///< the light that a light sample is taken of
  /// The light that rays find when they leave the scene, or null; and its index.
  const EnvironmentLight* environment = nullptr;
  uint32_t environment_index = kNone;
  std::unique_ptr<Camera> camera;
  std::vector<std::unique_ptr<GridVolume>> volumes;
  std::vector<std::unique_ptr<PhaseFunction>> phases;
  std::vector<std::unique_ptr<Medium>> media;
  /// The medium that the camera stands in, or null.
  const Medium* camera_medium = nullptr;
  /// The medium that a ray from the camera is in when it has left the scene, or null.
  const Medium* outermost_medium = nullptr;
  /// The medium that each light sends its rays into; empty with PathVertex.
  std::vector<LightMedium> light_media;
  /// Whether light may pass straight through any surface.
  bool has_passable_surfaces = false;
  /// Whether such surfaces are no vertices of paths (SceneDescription::counts_passed_surfaces).
  bool skips_passed_surfaces = false;
  std::unique_ptr<Accel> accel;
  SceneFeatures features;  ///< of the description that this was built from
  /// Moves the scene between passes, for one render at a time (MotionLease); null if it stands
  /// still while the shutter is open.
  std::shared_ptr<SceneMotion> motion;

  /// Whether light is scattered between surfaces, or passes some that are no vertices: sub-paths
  /// are those of MediaVertex then.
  bool needs_media_vertices() const { return !media.empty() || skips_passed_surfaces; }

  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  Surface surface(const Ray& ray, const Hit& hit) const {
    const Shape& shape = shapes[hit.shape];
    if (hit.instance != kNone) return make_surface(shape, &instances[hit.instance], ray, hit);
    if (shape.kind == ShapeKind::mesh) [[likely]]
      return make_mesh_surface(shape, hit);
    return make_surface(shape, nullptr, ray, hit);
  }
  /// The light on a shape, or null.
  const SurfaceLight* light_on(const Shape& shape) const {
    return shape.light == kNone ? nullptr
                                : static_cast<const SurfaceLight*>(lights[shape.light].get());
  }
  /// The medium into which a ray leaves a surface that separates_media(), or null.
  const Medium* medium_beyond(const Surface& s, const Vector3f& direction) const {
    const uint32_t m = dot(s.ng, direction) > 0 ? s.shape->exterior : s.shape->interior;
    return m == kNone ? nullptr : media[m].get();
  }
};

}  // namespace duet
