#include "geometry/shape_points.h"

#include <cmath>

namespace duet {

ShapePoints::ShapePoints(const Shape& shape) : shape_(shape) {
  if (!shape.mesh) return;
  std::vector<float> areas;
  for (uint32_t i = 0; i < shape.mesh->triangles.size(); ++i)
    areas.push_back(triangle_area(*shape.mesh, i));
  triangles_ = DiscreteDistribution(areas);
}

ShapePoint ShapePoints::sample(const Point2f& u) const {
  if (!shape_.mesh) return sample_analytic(shape_, u);
  const auto pick = triangles_.sample(u.x, u);
  return sample_triangle(shape_, pick.index, {pick.remapped, u.y});
}

bool ShapePoints::is_even(const Shape& shape) {
  if (shape.mesh) return true;
  if (shape.kind == ShapeKind::sdf_grid) return false;
  const double uniform = 1 / surface_area(shape);
  for (const Point2f u : {Point2f{0.1f, 0.2f}, {0.3f, 0.9f}, {0.6f, 0.4f}, {0.9f, 0.7f}})
    if (!(std::abs(double(sample_analytic(shape, u).pdf.value) - uniform) < 1e-3 * uniform))
      return false;
  return true;
}

}  // namespace duet
