// What layers say of the first hit.
#include "integrators/layers.h"

#include <doctest/doctest.h>

#include "cameras/batch.h"
#include "cameras/meters.h"
#include "cameras/orthographic.h"
#include "geometry/accel.h"
#include "support/table_cameras.h"
#include "support/transport_scene.h"

using namespace duet;

namespace {

Shape to_shape(const std::string& name, const Matrix4& place) {
  Shape s;
  s.needs = {true, true};
  if (name == "rectangle") {
    TriangleMesh mesh = make_rectangle();
    transform_mesh(mesh, place);
    mesh.positions.reserve(mesh.positions.size() + 1);
    s.mesh = std::make_shared<TriangleMesh>(std::move(mesh));
    return s;
  }
  s.kind = name == "sphere" ? ShapeKind::sphere : ShapeKind::cylinder;
  s.to_world = Transform(place);
  s.to_local = *place.inverse();
  return s;
}

Point2f change(LayerKind kind, const Surface& s, const std::optional<NextRays>& next) {
  float out[2] = {0, 0};
  evaluate_layer(kind, Scene(), {s, {0, 0, 1}, Hit(), next ? &*next : nullptr}, out);
  return {out[0], out[1]};
}

}  // namespace

TEST_CASE("texture coordinates change from pixel to pixel as Mitsuba says") {
  const test::Json table = test::read_table("uv_partials");
  for (const test::Json& c : table["cases"]) {
    const auto camera = test::to_camera(c);
    const std::vector<Shape> shapes{to_shape(c["shape"], test::to_matrix(c["place"]))};
    const std::vector<ShapeRange> groups;
    const std::vector<Instance> instances;
    const Accel accel(shapes, {0, 1}, groups, instances, 1);
    for (const test::Json& row : c["found"]) {
      INFO(c["kind"].dump() << c["shape"].dump() << row.dump());
      const Point2f film{row[0].get<float>(), row[1].get<float>()},
          lens{row[2].get<float>(), row[3].get<float>()};
      const Ray ray = camera->sample_ray(film, lens);
      Hit hit;
      REQUIRE(accel.closest_hit(ray, hit));
      const Surface s = make_surface(shapes[0], nullptr, ray, hit);
      const auto next = camera->next_rays(film, lens);
      REQUIRE(next);
      const Point2f dx = change(LayerKind::duv_dx, s, next),
                    dy = change(LayerKind::duv_dy, s, next);
      const float found[] = {dx.x, dx.y, dy.x, dy.y};
      float size = 0;
      for (size_t i = 4; i < 8; ++i) size = std::max(size, std::abs(row[i].get<float>()));
      for (size_t i = 0; i < 4; ++i)
        CHECK(std::abs(found[i] - row[4 + i].get<float>()) < 1e-3f * size);
    }
  }
}

TEST_CASE("nothing changes where nothing is seen, or no neighbour is") {
  Surface s;
  Shape shape = to_shape("rectangle", Matrix4());
  s.shape = &shape;
  s.position = {0, 0, 0};
  s.ng = {0, 0, 1};
  s.dp_du = {1, 0, 0};
  s.dp_dv = {0, 1, 0};
  const Ray along{{0, 0, 1}, {1, 0, 0}, INFINITY}, down{{0.5f, 0.25f, 1}, {0, 0, -1}, INFINITY};
  CHECK(change(LayerKind::duv_dx, s, NextRays{down, along}) == Point2f{0.5f, 0.25f});
  CHECK(change(LayerKind::duv_dy, s, NextRays{down, along}) == Point2f{0, 0});
  CHECK(change(LayerKind::duv_dx, s, std::nullopt) == Point2f{0, 0});
  s.dp_dv = s.dp_du;
  CHECK(change(LayerKind::duv_dx, s, NextRays{down, along}) == Point2f{0, 0});
}

TEST_CASE("linear curves and grids of distances have no derivatives, as in Mitsuba") {
  Shape shape;
  shape.kind = ShapeKind::sdf_grid;
  Surface s;
  s.shape = &shape;
  s.position = {0, 0, 0};
  s.ng = {0, 0, 1};
  s.dp_du = {1, 0, 0};
  s.dp_dv = {0, 1, 0};
  const Ray down{{0.5f, 0.25f, 1}, {0, 0, -1}, INFINITY};
  const NextRays next{down, down};
  const auto all_zero = [&] {
    bool zero = true;
    for (const LayerKind kind :
         {LayerKind::dp_du, LayerKind::dp_dv, LayerKind::duv_dx, LayerKind::duv_dy}) {
      float out[3] = {0, 0, 0};
      evaluate_layer(kind, Scene(), {s, {0, 0, 1}, Hit(), &next}, out);
      for (const float v : out) zero &= v == 0;
    }
    return zero;
  };
  CHECK(all_zero());
  shape.kind = ShapeKind::curves;
  auto curves = std::make_shared<CurveSet>();
  shape.curves = curves;
  CHECK(all_zero());
  curves->kind = CurveKind::bspline;
  CHECK(!all_zero());
}

TEST_CASE("meters have no neighbouring rays, and each camera of a batch has its own") {
  CHECK(!FluenceMeter(Transform(Matrix4())).next_rays({0.5f, 0.5f}, {}));
  std::vector<std::unique_ptr<Camera>> cameras;
  for (const double x : {0.0, 100.0})
    cameras.push_back(std::make_unique<OrthographicCamera>(
        OrthographicView{Transform(Matrix4::translate(x, 0, 0)), {4, 4}}));
  const CameraBatch batch(std::move(cameras), 4);
  // The last pixel of the first strip: its neighbour is not the first of the second one.
  const auto next = batch.next_rays({3.5f, 0.5f}, {});
  REQUIRE(next);
  CHECK(next->right.origin.x == doctest::Approx(-1.25));
  CHECK(batch.next_rays({4.5f, 0.5f}, {})->right.origin.x == doctest::Approx(100.25));
}

TEST_CASE("the layers of an image have the change of texture coordinates per pixel") {
  const test::TransportScene scene(
      "<sensor type='orthographic'><transform name='to_world'><lookat origin='0, 0, 5' target='0, "
      "0, 0' up='0, 1, 0'/></transform><film type='hdrfilm'><integer name='width' "
      "value='8'/><integer name='height' value='4'/><rfilter type='box'/></film></sensor>"
      "<integrator type='aov'><string name='aovs' value='a:duv_dx, b:duv_dy'/></integrator>"
      "<shape type='rectangle'/>");
  for (const int spp : {1, 16}) {
    RenderRequest request;
    request.budget.spp = spp;
    const auto integrator = make_integrator(scene.integrator);
    const Image image = render(*scene.scene, *integrator, scene.layout, request).image;
    REQUIRE(image.channels == std::vector<std::string>{"a.U", "a.V", "b.U", "b.V"});
    const float expected[] = {1 / 8.0f, 0, 0, -1 / 8.0f};
    for (size_t i = 0; i < image.data.size(); ++i)
      CHECK(image.data[i] == doctest::Approx(expected[i % 4]).epsilon(1e-4));
  }
}
