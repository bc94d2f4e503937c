// Short ways to read one plugin of a scene, for the tests of what its parameters become.
#pragma once

#include <doctest/doctest.h>

#include "support/memory_scene.h"

namespace duet::test {

inline MemoryFiles image() {
  MemoryFiles files;
  for (const char* name : {"a.png", "b.exr", "a.obj", "a.ply", "a.serialized"})
    files.texts[std::string("/scene/") + name] = "x";
  return files;
}

inline SceneDescription good(const std::string& version, const std::string& content) {
  const ReadResult r = read_scene(version, content, image());
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description();
}

template <class M>
M bsdf(const std::string& version, const std::string& type, const std::string& content = "") {
  const SceneDescription d = good(version, "<bsdf type='" + type + "'>" + content + "</bsdf>");
  return d.materials.back().model.get<M>();
}

template <class T>
T texture(const std::string& version, const std::string& type, const std::string& content = "") {
  const SceneDescription d =
      good(version, "<texture type='" + type + "'>" + content + "</texture>");
  return std::get<T>(d.textures.back().model);
}

template <class L>
std::pair<L, Matrix4> light(const std::string& version, const std::string& type,
                            const std::string& content = "") {
  const SceneDescription d =
      good(version, "<emitter type='" + type + "'>" + content + "</emitter>");
  return {std::get<L>(d.lights.at(0).model), d.lights.at(0).to_world};
}

inline SensorDescription sensor(const std::string& version, const std::string& type,
                                const std::string& content = "") {
  const ReadResult r =
      read_text("<scene version='" + version + "'><integrator type='path'/><sensor type='" + type +
                "'>" + content + "</sensor></scene>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().sensors.at(0);
}

inline FilmDescription film(const std::string& version, const std::string& type,
                            const std::string& content) {
  return sensor(version, "perspective", "<film type='" + type + "'>" + content + "</film>").film;
}

inline IntegratorDescription integrator(const std::string& version, const std::string& element) {
  const ReadResult r = read_text("<scene version='" + version + "'><sensor type='perspective'/>" +
                                 element + "</scene>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().integrator;
}

inline bool fails(const std::string& version, const std::string& content,
                  const std::string& message) {
  const ReadResult r = read_scene(version, content, image());
  INFO(r.messages());
  CHECK(!r.scene);
  return r.has(message);
}

inline const std::string kBoard = "<texture type='checkerboard'/>";

/// Row after row.
inline void check_matrix(const Matrix4& m, const std::array<double, 16>& expected,
                         double tolerance = 1e-6) {
  for (int i = 0; i < 16; ++i) {
    CAPTURE(i);
    CHECK(std::abs(m[i / 4][i % 4] - expected[i]) <= tolerance);
  }
}

}  // namespace duet::test
