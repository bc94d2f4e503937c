// From a description to a scene: the one place where things are made by name.
#pragma once

#include <memory>

#include "base/diagnostics.h"
#include "scene/description.h"
#include "scene/scene.h"

namespace duet {

struct SceneNames;

/// The most images that are read at the same time: each takes memory besides its texels.
inline constexpr int kImagesAtOnce = 4;

struct BuildOptions {
  /// Which of the description's sensors to look through.
  size_t sensor = 0;
  int threads = 1;
  /// What the image's layers ask of all surfaces, on top of what the materials need.
  SurfaceNeeds layer_needs;
  /// Is told what the things in the scene are called, if it is not null.
  SceneNames* names = nullptr;
};

/// Builds what the description says; null, with errors in `diagnostics`, if something in it cannot
/// be built (a missing image, a transform that cannot be inverted, …). All such errors are reported
/// together. The description's meshes move into the scene where nothing else holds them. What moves
/// while the shutter of the sensor is open is posed by Scene::motion and begins at half of the
/// time; if nothing does, the scene is as it is when the shutter opens.
std::unique_ptr<Scene> build_scene(SceneDescription description, const BuildOptions& options,
                                   Diagnostics& diagnostics);

}  // namespace duet
