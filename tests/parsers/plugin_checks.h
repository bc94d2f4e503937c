// Short ways to read one plugin of a scene, for the tests of what its parameters become.
#pragma once

#include <doctest/doctest.h>

#include "support/memory_scene.h"

namespace duet::test {

MemoryFiles image();

SceneDescription good(const std::string& version, const std::string& content);

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

SensorDescription sensor(const std::string& version, const std::string& type,
                         const std::string& content = "");

FilmDescription film(const std::string& version, const std::string& type,
                     const std::string& content);

IntegratorDescription integrator(const std::string& version, const std::string& element);

bool fails(const std::string& version, const std::string& content, const std::string& message);

inline const std::string kBoard = "<texture type='checkerboard'/>";

/// Row after row.
void check_matrix(const Matrix4& m, const std::array<double, 16>& expected,
                  double tolerance = 1e-6);

}  // namespace duet::test
