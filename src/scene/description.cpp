#include "scene/description.h"

namespace duet {

namespace {

/// Calls `visit` with each shape, light and sensor that may move.
template <class Scene, class Visit>
void for_each_movable(Scene& scene, Visit visit) {
  for (auto& s : scene.shapes) visit(s);
  for (auto& l : scene.lights) visit(l);
  for (auto& s : scene.sensors) visit(s);
}

}  // namespace

SceneDescription::SceneDescription() = default;
SceneDescription::SceneDescription(const SceneDescription&) = default;
SceneDescription::SceneDescription(SceneDescription&&) noexcept = default;
SceneDescription& SceneDescription::operator=(const SceneDescription&) = default;
SceneDescription& SceneDescription::operator=(SceneDescription&&) noexcept = default;
SceneDescription::~SceneDescription() = default;

size_t count_moving(const SceneDescription& scene) {
  size_t count = 0;
  for_each_movable(scene, [&](const auto& thing) { count += !thing.motion.empty(); });
  return count;
}

SceneDescription scene_at(SceneDescription scene, double time) {
  for_each_movable(scene, [&](auto& thing) {
    if (thing.motion.empty()) return;
    thing.to_world = thing.motion.at(time) * thing.to_world;
    thing.motion = {};
  });
  return scene;
}

}  // namespace duet
