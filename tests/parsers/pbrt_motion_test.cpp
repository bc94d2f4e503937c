// What moves in the objects of pbrt files.
#include <doctest/doctest.h>

#include <cmath>

#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription moving_world(const std::string& world) {
  const TemporaryDirectory folder;
  return scene_of(read_pbrt_file(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + world)));
}

}  // namespace

TEST_CASE("pbrt instances: what moves in an object moves wherever the object is used") {
  const auto both = [](const std::string& place) {
    return moving_world(
        "ObjectBegin \"a\"\nAttributeBegin\nActiveTransform EndTime\nTranslate 4 0 0\n"
        "Rotate 60 0 0 1\nActiveTransform All\nShape \"sphere\"\nAttributeEnd\n"
        "Shape \"cylinder\"\nObjectEnd\n" +
        place + "ObjectInstance \"a\"\n");
  };
  const auto group_of = [](const SceneDescription& d, size_t i) {
    return std::get<InstanceShape>(d.shapes.at(i).geometry).group;
  };
  const SceneDescription still = both("Translate 0 2 0\nRotate 90 0 0 1\nScale 2 2 2\n");
  REQUIRE(still.shapes.size() == 2);
  CHECK(still.shapes[1].motion.empty());
  CHECK(still.groups.at(group_of(still, 1)).shapes.size() == 1);
  CHECK(still.groups.at(group_of(still, 0)).shapes.at(0).motion.empty());
  const auto origin = [](const SceneDescription& d, double time) {
    const Matrix4 pose = d.shapes.at(0).motion.at(time);
    return Vector3f(float(pose[0][3]), float(pose[1][3]), float(pose[2][3]));
  };
  for (const float t : {0.0f, 0.25f, 1.0f})
    CHECK(length(origin(still, double(t)) - Vector3f(0, 2 + 8 * t, 0)) < 1e-5f);
  // Stretched, and on the move themselves.
  const SceneDescription uneven = both("Rotate 90 0 0 1\nScale 2 1 1\n");
  for (const float t : {0.0f, 0.25f, 0.5f, 1.0f})
    CHECK(length(origin(uneven, double(t)) - Vector3f(0, 8 * t, 0)) < 1e-5f);
  const Matrix4 halved = uneven.shapes.at(0).motion.at(0.5),
                expected = Matrix4::rotate(90, 0, 0, 1) * Matrix4::scale(2, 1, 1) *
                           Matrix4::translate(2, 0, 0) * Matrix4::rotate(30, 0, 0, 1);
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) CHECK(halved[i][j] == doctest::Approx(expected[i][j]).scale(1));
  const SceneDescription moving =
      both("ActiveTransform EndTime\nTranslate 0 0 8\nActiveTransform All\n");
  REQUIRE(moving.shapes.size() == 2);
  for (const float t : {0.0f, 0.25f, 0.5f, 1.0f})
    CHECK(length(origin(moving, double(t)) - Vector3f(4 * t, 0, 8 * t)) < 1e-5f);
  CHECK_FALSE(moving.shapes[1].motion.empty());
}
