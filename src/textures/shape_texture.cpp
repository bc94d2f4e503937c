#include "textures/shape_texture.h"

namespace duet {

Point2f by_texture_coordinates(const TriangleMesh& mesh, uint32_t triangle, const Point2f& f) {
  const auto& t = mesh.triangles[triangle];
  const Point2f a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const float det = a.x * b.y - a.y * b.x;
  if (det == 0) return {0, 0};
  return {(f.x * b.y - f.y * a.y) / det, (f.y * a.x - f.x * b.x) / det};
}

}  // namespace duet
