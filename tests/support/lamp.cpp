#include "support/lamp.h"

namespace duet::test {

Shape analytic(ShapeKind kind, const Matrix4& to_world, bool flip) {
  Shape s;
  s.kind = kind;
  s.to_world = Transform(to_world);
  s.to_local = *to_world.inverse();
  s.flip_normals = flip;
  return s;
}

Shape mesh(TriangleMesh m, const Matrix4& to_world) {
  transform_mesh(m, to_world);
  Shape s;
  s.mesh = std::make_shared<TriangleMesh>(std::move(m));
  return s;
}

TriangleMesh fan() {
  TriangleMesh m;
  m.positions = {{0, 0, 0}, {2, 0, 0}, {1.5f, 1, 0}, {-0.5f, 2, 0}, {-2, 0.2f, 0}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  return m;
}

}  // namespace duet::test
