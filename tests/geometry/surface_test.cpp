#include "geometry/surface.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "geometry/accel.h"
#include "support/tables.h"

using namespace duet;

namespace {

struct Geometry {
  std::vector<Shape> shapes;
  std::vector<ShapeRange> groups;
  std::vector<Instance> instances;
  std::unique_ptr<Accel> accel;

  explicit Geometry(Shape shape, const std::optional<Matrix4>& instance = {}) {
    shape.needs = {true, true};
    shapes.push_back(std::move(shape));
    ShapeRange top{0, 1};
    if (instance) {
      groups.push_back(top);
      top.count = 0;
      instances.push_back({0, Transform(*instance), 3});
    }
    accel = std::make_unique<Accel>(shapes, top, groups, instances, 1);
  }

  std::optional<Surface> intersect(const Ray& ray, Hit& hit) const {
    if (!accel->closest_hit(ray, hit)) return std::nullopt;
    return make_surface(shapes[0], instances.empty() ? nullptr : &instances[0], ray, hit);
  }
};

Shape make_shape(const std::string& name, const Matrix4& to_world, const TriangleMesh& roof) {
  Shape s;
  if (name == "sphere" || name == "disk" || name == "cylinder") {
    s.kind = name == "sphere" ? ShapeKind::sphere
             : name == "disk" ? ShapeKind::disk
                              : ShapeKind::cylinder;
    s.to_world = Transform(to_world);
    s.to_local = *to_world.inverse();
    return s;
  }
  TriangleMesh mesh = name == "rectangle" ? make_rectangle() : name == "cube" ? make_cube() : roof;
  if (name.starts_with("mesh")) {
    if (name.find('n') == std::string::npos) mesh.normals.clear();
    if (name.find('u') == std::string::npos) mesh.uvs.clear();
  }
  transform_mesh(mesh, to_world);
  mesh.positions.reserve(mesh.positions.size() + 1);
  s.mesh = std::make_shared<TriangleMesh>(std::move(mesh));
  return s;
}

float difference(const Vector3f& a, const Vector3f& b) {
  return max_abs(a - b);
}

}  // namespace

TEST_CASE("shapes are where Mitsuba has them, with its normals, coordinates and tangents") {
  const test::Json table = test::read_table("surfaces");
  const TriangleMesh roof = test::to_mesh(table["mesh"]);
  for (const test::Json& c : table["cases"]) {
    const std::string name = c["shape"];
    std::optional<Matrix4> instance;
    if (!c["instance"].is_null()) instance = test::to_matrix(c["instance"]);
    Shape shape = make_shape(name, test::to_matrix(c["to_world"]), roof);
    shape.flip_normals = c["flip"];
    const Geometry geometry(shape, instance);
    for (const test::Json& row : c["hits"]) {
      INFO(fmt::format("{} flip {} mirrored {} instance {} row {}", name, bool(c["flip"]),
                       test::to_matrix(c["to_world"]).determinant3() < 0, instance.has_value(),
                       row.dump()));
      const Ray ray{test::triple<Point3f>(row, 0), test::triple<Vector3f>(row, 3), INFINITY};
      Hit hit;
      const auto s = geometry.intersect(ray, hit);
      REQUIRE(s);
      const float size = 3;
      CHECK(hit.t == doctest::Approx(row[6].get<float>()).epsilon(1e-5));
      CHECK(max_abs(s->position - test::triple<Point3f>(row, 7)) < 1e-5f * size);
      const auto n = test::triple<Normal3f>(row, 10), ns = test::triple<Normal3f>(row, 13);
      CHECK(difference(Vector3f(s->shading.n), Vector3f(ns)) < 1e-5f);
      // Duet's geometric normal is on the side of the shading normal.
      CHECK(difference(Vector3f(s->ng), Vector3f(dot(n, ns) < 0 ? -n : n)) < 1e-5f);
      CHECK(s->uv.x == doctest::Approx(row[16].get<float>()).epsilon(2e-5));
      CHECK(s->uv.y == doctest::Approx(row[17].get<float>()).epsilon(2e-5));
      CHECK(difference(s->dp_du, test::triple<Vector3f>(row, 18)) < 1e-4f * (1 + length(s->dp_du)));
      CHECK(difference(s->dp_dv, test::triple<Vector3f>(row, 21)) < 1e-4f * (1 + length(s->dp_dv)));
      CHECK(difference(s->shading.s, test::triple<Vector3f>(row, 24)) < 1e-4f);
    }
  }
}
