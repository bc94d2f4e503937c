#include "parsers/plugin_checks.h"

namespace duet::test {

MemoryFiles image() {
  MemoryFiles files;
  for (const char* name : {"a.png", "b.exr", "a.obj", "a.ply", "a.serialized"})
    files.texts[std::string("/scene/") + name] = "x";
  return files;
}

SceneDescription good(const std::string& version, const std::string& content) {
  const ReadResult r = read_scene(version, content, image());
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description();
}

SensorDescription sensor(const std::string& version, const std::string& type,
                         const std::string& content) {
  const ReadResult r =
      read_text("<scene version='" + version + "'><integrator type='path'/><sensor type='" + type +
                "'>" + content + "</sensor></scene>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().sensors.at(0);
}

FilmDescription film(const std::string& version, const std::string& type,
                     const std::string& content) {
  return sensor(version, "perspective", "<film type='" + type + "'>" + content + "</film>").film;
}

IntegratorDescription integrator(const std::string& version, const std::string& element) {
  const ReadResult r = read_text("<scene version='" + version + "'><sensor type='perspective'/>" +
                                 element + "</scene>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().integrator;
}

bool fails(const std::string& version, const std::string& content, const std::string& message) {
  const ReadResult r = read_scene(version, content, image());
  INFO(r.messages());
  CHECK(!r.scene);
  return r.has(message);
}

void check_matrix(const Matrix4& m, const std::array<double, 16>& expected, double tolerance) {
  for (int i = 0; i < 16; ++i) {
    CAPTURE(i);
    CHECK(std::abs(m[i / 4][i % 4] - expected[i]) <= tolerance);
  }
}

}  // namespace duet::test
