// A scene that a program puts together, and what is put into it.
#pragma once

#include "duet/scene_description.h"

namespace duet::test {

/// A sensor and a sky.
inline SceneObject empty_scene() {
  SceneObject film("film", "hdrfilm");
  film.set("width", 24).set("height", 16).set("component_format", "float32");
  SceneObject sensor("sensor", "perspective", "eye");
  sensor.set("fov", 60).set("to_world",
                            SceneTransform::look_at({0.25, 1, 5}, {0, 0, 0}, {0, 1, 0}));
  sensor.add(SceneObject("sampler", "independent").set("sample_count", 4)).add(film);
  SceneObject scene = SceneObject::scene();
  scene.add(SceneObject("integrator", "path").set("max_depth", 5)).add(sensor);
  scene.add(SceneObject("emitter", "constant").set("radiance", SceneRgb{0.5, 0.6, 0.7}));
  return scene;
}

inline SceneObject with(const SceneObject& object) {
  return empty_scene().add(object);
}

inline SceneObject ball(const std::string& id = "ball") {
  return {"shape", "sphere", id};
}

/// A bent square of four triangles around its middle.
inline SceneMesh bent_square() {
  SceneMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0.25f}, {1, 1, 0}, {-1, 1, 0.125f}, {0, 0, 0.6f}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return mesh;
}

inline SceneMesh bent_square_with_normals() {
  SceneMesh mesh = bent_square();
  mesh.normals = {
      {-0.5f, -0.5f, 2}, {0.5f, -0.5f, 1}, {0.5f, 0.5f, 1}, {-0.5f, 0.5f, 1}, {0, 0, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.4f, 0.6f}};
  return mesh;
}

}  // namespace duet::test
