#include "geometry/mesh.h"

namespace duet {

const MeshAttribute* TriangleMesh::find_attribute(const std::string& name) const {
  for (const MeshAttribute& a : attributes)
    if (a.name == name) return &a;
  return nullptr;
}

Normal3f normalized_or_zero(const Normal3f& n) {
  const float scale = max_abs(n);
  if (!is_finite(n) || !(scale > 0)) return Normal3f{};
  // First by the largest component, so that no square overflows or vanishes.
  return normalize(Normal3f{n.x / scale, n.y / scale, n.z / scale});
}

void transform_mesh(TriangleMesh& mesh, const Matrix4& to_world) {
  if (to_world == Matrix4{}) return;
  const Transform transform(to_world);
  for (Point3f& p : mesh.positions) p = transform(p);
  if (mesh.computed_normals) {
    compute_vertex_normals(mesh);
    return;
  }
  for (Normal3f& n : mesh.normals) n = normalized_or_zero(transform(n));
}

TriangleMesh make_cube() {
  // Per face: the normal and the directions of increasing u and v.
  struct Face {
    Vector3f n, u, v;
  };
  static constexpr std::array<Face, 6> kFaces{{{{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                                               {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                               {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                               {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                               {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                               {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}}};
  static constexpr std::array<Point2f, 4> kCorners{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  TriangleMesh mesh;
  for (const Face& f : kFaces) {
    const uint32_t base = uint32_t(mesh.positions.size());
    for (const Point2f& c : kCorners) {
      const Vector3f p = f.n + f.u * (2 * c.x - 1) + f.v * (2 * c.y - 1);
      mesh.positions.push_back(Point3f(p));
      mesh.normals.push_back(Normal3f(f.n));
      mesh.uvs.push_back(c);
    }
    mesh.triangles.push_back({base, base + 1, base + 2});
    mesh.triangles.push_back({base + 3, base, base + 2});
  }
  return mesh;
}

TriangleMesh make_rectangle() {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace duet
