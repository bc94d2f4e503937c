// A scene whose surfaces are looked at from above.
#pragma once

#include <doctest/doctest.h>

#include "scene/build.h"
#include "support/memory_scene.h"

namespace duet::test {

struct TexturedScene {
  std::unique_ptr<Scene> scene;
  ReadResult read;

  /// `content` is what stands within the <scene>; it is built unless that fails.
  TexturedScene(const std::string& version, const std::string& content)
      : read(read_scene(version, content)) {
    REQUIRE_MESSAGE(read.scene, read.messages());
    scene = build_scene(read.scene->description, {}, read.diagnostics);
  }

  /// The albedo of what a ray down along z meets first.
  Spectrum albedo(float x, float y) const {
    REQUIRE_MESSAGE(scene, read.messages());
    const Ray ray{{x, y, 100}, {0, 0, -1}, INFINITY};
    Hit hit;
    REQUIRE(scene->accel->closest_hit(ray, hit));
    const Surface s = scene->surface(ray, hit);
    return scene->materials[s.shape->material]->albedo(s, {0, 0, 1});
  }
};

}  // namespace duet::test
