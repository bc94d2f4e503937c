#include "scene/scene.h"

namespace duet {

Scene::Scene() = default;
Scene::~Scene() = default;

}  // namespace duet
