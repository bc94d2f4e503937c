#include "textures/curvature_texture.h"

namespace duet {

std::string CurvatureMap::add_shape(const Shape& shape, bool) {
  return has_curvature(shape.kind) ? "" : "known curvature";
}

Spectrum CurvatureMap::color(const Surface& s) const {
  const Curvature c = curvature_at(s);
  const float v = scale_ * (shown_ == CurvatureKind::mean ? c.mean : c.gaussian);
  return {std::clamp(v, 0.0f, 1.0f), 0, std::clamp(-v, 0.0f, 1.0f)};
}

Point2f CurvatureMap::gradient(const Surface& s) const {
  constexpr float kStep = 1e-3f;
  const TriangleMesh* mesh = s.shape->mesh.get();
  const auto slope = [&](float x, float y) {
    Surface before = s, after = s;
    const Point2f at = mesh ? s.barycentric : s.uv;
    (mesh ? before.barycentric : before.uv) = at - Point2f{x, y};
    (mesh ? after.barycentric : after.uv) = at + Point2f{x, y};
    return (value(after) - value(before)) / (2 * kStep);
  };
  const Point2f g{slope(kStep, 0), slope(0, kStep)};
  return mesh && !mesh->uvs.empty() ? by_texture_coordinates(*mesh, s.primitive, g) : g;
}

}  // namespace duet
