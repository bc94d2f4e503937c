// Surfaces that emit, alone in the world, for tests of lights.
#pragma once

#include "geometry/accel.h"
#include "lights/area.h"

namespace duet::test {

/// An emitting shape alone in the world.
struct Lamp {
  std::vector<Shape> shapes;
  std::vector<ShapeRange> groups;
  std::vector<Instance> instances;
  std::unique_ptr<Accel> accel;
  std::unique_ptr<AreaLight> light;

  Lamp(Shape shape, const ColorSlot& radiance, EmittingSide side = EmittingSide::shading) {
    if (shape.mesh) {
      auto mesh = std::make_shared<TriangleMesh>(*shape.mesh);
      mesh->positions.reserve(mesh->positions.size() + 1);
      shape.mesh = mesh;
    }
    shape.needs.uv = radiance.needs_uv();
    shapes.push_back(std::move(shape));
    accel = std::make_unique<Accel>(shapes, ShapeRange{0, 1}, groups, instances, 1);
    light = std::make_unique<AreaLight>(shapes[0], radiance, side);
  }
  /// The surface in a direction and its squared distance.
  std::optional<Surface> look(const Point3f& from, const Vector3f& w, float& d2) const {
    Hit hit;
    const Ray ray{from, w, INFINITY};
    if (!accel->closest_hit(ray, hit)) return std::nullopt;
    const Surface s = make_surface(shapes[0], nullptr, ray, hit);
    d2 = length_squared(s.position - from);
    return s;
  }
};

Shape analytic(ShapeKind kind, const Matrix4& to_world, bool flip = false);

Shape mesh(TriangleMesh m, const Matrix4& to_world);

/// Three triangles of unequal size side by side, facing +z.
TriangleMesh fan();

}  // namespace duet::test
