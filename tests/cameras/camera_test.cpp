// Camera rays against Mitsuba's.
#include "cameras/camera.h"

#include <doctest/doctest.h>

#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "math/fov.h"
#include "support/tables.h"

using namespace duet;

namespace {

FovAxis to_axis(const std::string& name) {
  return name == "y"          ? FovAxis::y
         : name == "diagonal" ? FovAxis::diagonal
         : name == "smaller"  ? FovAxis::smaller
         : name == "larger"   ? FovAxis::larger
                              : FovAxis::x;
}

std::unique_ptr<Camera> to_camera(const test::Json& c) {
  const test::Json& p = c["parameters"];
  const Transform to_world(test::to_matrix(c["to_world"]));
  const Point2i film{c["size"][0], c["size"][1]};
  if (c["kind"] == "orthographic")
    return std::make_unique<OrthographicCamera>(
        OrthographicView{to_world, film, p["near_clip"], p["far_clip"]});
  PerspectiveView view;
  view.to_world = to_world;
  view.film = film;
  view.horizontal_fov =
      horizontal_fov(p["fov"], to_axis(p.value("fov_axis", "x")), double(film.x) / double(film.y));
  view.offset_x = p.value("principal_point_offset_x", 0.0);
  view.offset_y = p.value("principal_point_offset_y", 0.0);
  view.near_clip = p["near_clip"];
  view.far_clip = p["far_clip"];
  if (c["kind"] == "thinlens")
    return std::make_unique<ThinLensCamera>(view, p["aperture_radius"], p["focus_distance"]);
  return std::make_unique<PerspectiveCamera>(view);
}

}  // namespace

TEST_CASE("cameras send the rays that Mitsuba's send") {
  const test::Json table = test::read_table("cameras");
  for (const test::Json& c : table["cameras"]) {
    const auto camera = to_camera(c);
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
