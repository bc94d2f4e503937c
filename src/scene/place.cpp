// Moves what is in a scene that has been built.
#include <algorithm>

#include "cameras/realistic.h"
#include "lights/delta.h"
#include "lights/environment.h"
#include "scene/builder.h"

namespace duet {

void SceneBuilder::place_instance(uint32_t index, const Matrix4& to_world) {
  Instance& instance = scene_->instances[index];
  instance = make_instance(instance.group, to_world);
  moved_instances_.push_back(index);
}

void SceneBuilder::place_shape(uint32_t index, const Matrix4& to_world, const TriangleMesh* local) {
  Shape& shape = scene_->shapes[index];
  if (local) {
    TriangleMesh moved = *local;
    transform_mesh(moved, to_world);
    // The arrays stay where they are.
    TriangleMesh& mesh = *movable_meshes_.at(index);
    std::copy(moved.positions.begin(), moved.positions.end(), mesh.positions.begin());
    if (!mesh.normals.empty()) mesh.normals = std::move(moved.normals);
  } else {
    shape.to_world = Transform(to_world);
    shape.to_local = *to_world.inverse();
  }
  moved_shapes_.push_back(index);
  for (size_t k = 0; k < emissions_.size(); ++k)
    if (emissions_[k].shape == index) scene_->lights[k] = make(emissions_[k], shape);
  const SensorDescription& sensor = description_.sensors[options_.sensor];
  if (sensor.kind == SensorKind::irradiancemeter && shape_index(sensor.shape) == index)
    place_sensor(sensor.to_world);
}

void SceneBuilder::place_light(uint32_t index, const Matrix4& to_world) {
  LightDescription& d = description_.lights[index];
  d.to_world = to_world;
  const DescribedLight& described = described_lights_[index];
  if (std::holds_alternative<EnvironmentMapLight>(d.model) && !d.portal) {
    // The tables of an image do not turn with it.
    static_cast<EnvironmentMap&>(*described.light).turn(to_world);
    return;
  }
  if (std::holds_alternative<GoniometricLight>(d.model)) {
    static_cast<GoniometricEmitter&>(*described.light).place(Transform(to_world));
    return;
  }
  // The same from everywhere, however it turns.
  if (std::holds_alternative<ConstantLight>(d.model)) return;
  std::unique_ptr<Light>& light = scene_->lights[described.index];
  light = make(d);
  if (light->kind() == LightKind::environment)
    scene_->environment = static_cast<const EnvironmentLight*>(light.get());
}

void SceneBuilder::place_sensor(const Matrix4& to_world) {
  SensorDescription& d = description_.sensors[options_.sensor];
  d.to_world = to_world;
  if (d.kind == SensorKind::realistic && scene_->camera) {
    // Its pupil takes long to find.
    static_cast<RealisticCamera&>(*scene_->camera).place(Transform(to_world));
    return;
  }
  scene_->camera = camera(d, {d.film.width, d.film.height});
}

void SceneBuilder::settle() {
  scene_->accel->update(moved_shapes_, moved_instances_);
  moved_shapes_.clear();
  moved_instances_.clear();
  survey();
}

}  // namespace duet
