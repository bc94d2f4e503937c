#include "textures/wireframe.h"

namespace duet {

namespace {

/// Of the three edges of every triangle: an edge between two triangles counts twice, as in Mitsuba.
float mean_edge_length(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    for (size_t i = 0; i < 3; ++i)
      sum += double(length(mesh.positions[t[(i + 1) % 3]] - mesh.positions[t[i]]));
  return float(sum / (3 * double(mesh.triangles.size())));
}

}  // namespace

std::string Wireframe::add_shape(const Shape& shape, bool is_mesh) {
  if (is_mesh)
    line_width_.add(shape.mesh.get(), options_.line_width ? *options_.line_width
                                                          : 0.1f * mean_edge_length(*shape.mesh));
  return "";
}

float Wireframe::interior_share(const Surface& s, Point2f* derivatives) const {
  if (derivatives) *derivatives = {0, 0};
  const TriangleMesh* mesh = s.shape->mesh.get();
  const float* width = mesh ? line_width_.find(mesh) : nullptr;
  if (!width) return 1;
  const auto& t = mesh->triangles[s.primitive];
  const Point3f &p0 = mesh->positions[t[0]], &p1 = mesh->positions[t[1]],
                &p2 = mesh->positions[t[2]];
  const float twice_area = length(cross(p1 - p0, p2 - p0));
  // A point is a vertex's weight times its height from the edge across.
  const float height[] = {twice_area / length(p2 - p1), twice_area / length(p0 - p2),
                          twice_area / length(p1 - p0)};
  const Point2f& b = s.barycentric;
  const float distance[] = {(1 - b.x - b.y) * height[0], b.x * height[1], b.y * height[2]};
  const int nearest = int(std::min_element(distance, distance + 3) - distance);
  const float begin = *width * (1 - options_.step_width), step = *width - begin;
  if (!(distance[nearest] < *width)) return 1;
  if (!(distance[nearest] > begin)) return 0;
  const float x = (distance[nearest] - begin) / step;
  if (derivatives) {
    const float slope = 6 * x * (1 - x) / step * height[nearest];
    *derivatives = nearest == 0   ? Point2f{-slope, -slope}
                   : nearest == 1 ? Point2f{slope, 0}
                                  : Point2f{0, slope};
  }
  return x * x * (3 - 2 * x);
}

Spectrum Wireframe::color(const Surface& s) const {
  const float share = interior_share(s, nullptr);
  return options_.edge * (1 - share) + options_.interior * share;
}

Point2f Wireframe::gradient(const Surface& s) const {
  Point2f by_barycentric;
  interior_share(s, &by_barycentric);
  if (by_barycentric.x == 0 && by_barycentric.y == 0) return {0, 0};
  const TriangleMesh& mesh = *s.shape->mesh;
  const Point2f g =
      mesh.uvs.empty() ? by_barycentric : by_texture_coordinates(mesh, s.primitive, by_barycentric);
  return g * (options_.interior.luminance() - options_.edge.luminance());
}

}  // namespace duet
