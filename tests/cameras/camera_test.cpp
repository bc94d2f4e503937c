// Camera rays against Mitsuba's.
#include "cameras/camera.h"

#include <doctest/doctest.h>

#include "support/table_cameras.h"

using namespace duet;

TEST_CASE("cameras send the rays that Mitsuba's send") {
  const test::Json table = test::read_table("cameras");
  for (const test::Json& c : table["cameras"]) {
    const auto camera = test::to_camera(c);
    CHECK(camera->has_lens() == (c["kind"] == "thinlens"));
    for (const test::Json& row : c["rays"]) {
      INFO(c["kind"].dump() << c["size"].dump() << c["parameters"].dump() << row.dump());
      const Ray ray = camera->sample_ray({row[0].get<float>(), row[1].get<float>()},
                                         {row[2].get<float>(), row[3].get<float>()});
      CHECK(max_abs(ray.origin - test::triple<Point3f>(row, 4)) < 1e-5f);
      CHECK(max_abs(ray.direction - test::triple<Vector3f>(row, 7)) < 2e-6f);
      CHECK(length(ray.direction) == doctest::Approx(1).epsilon(1e-6));
      CHECK(ray.tmax == doctest::Approx(row[10].get<float>()).epsilon(1e-5));
    }
  }
}
