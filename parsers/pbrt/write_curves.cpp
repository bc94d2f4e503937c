// Curves as pbrt-v4 writes them.
#include <algorithm>
#include <cmath>

#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

using Segment = std::array<TubePoint, 4>;

/// The control points of a uniform B-spline.
Segment spline_of(const CurveSet& c, uint32_t segment) {
  if (c.kind == CurveKind::bspline)
    return {c.points[segment], c.points[segment + 1], c.points[segment + 2], c.points[segment + 3]};
  // A straight line, as long at either end as it takes a spline to begin there.
  const TubePoint &a = c.points[segment], &b = c.points[segment + 1];
  const Vector3f d = b.position - a.position;
  const float dr = b.radius - a.radius;
  return {{{a.position - d, a.radius - dr}, a, b, {b.position + d, b.radius + dr}}};
}

/// Where the segment begins (0) or ends (1).
double width(const Segment& p, size_t i) {
  return 2 * (double(p[i].radius) + 4 * double(p[i + 1].radius) + double(p[i + 2].radius)) / 6;
}

/// Whether the width changes steadily along the segment.
bool is_linear(const Segment& p) {
  const double step = double(p[2].radius) - double(p[1].radius);
  const double bound = 1e-3 * std::max(double(p[1].radius), double(p[2].radius));
  return std::abs(double(p[1].radius) - double(p[0].radius) - step) <= bound &&
         std::abs(double(p[3].radius) - double(p[2].radius) - step) <= bound;
}

}  // namespace

void SceneWriter::curves(const ShapeDescription& s, const CurveSet& c, const FloatInput& alpha) {
  const bool is_hair =
      holds(d_, s.material, [](const MaterialModel& m) { return m.is<HairMaterial>(); });
  if (c.profile == CurveProfile::tube && !is_hair)
    lose("curves that are tubes are ribbons that face each ray, with the normals of tubes");
  if (!s.motion.empty()) lose("curves do not move");
  if (c.segments.size() > 1 && looks_at_uv(s))
    lose("texture coordinates along curves begin anew at each of their segments");
  CurveSet placed = c;
  transform_curves(placed,
                   s.motion.empty() ? s.to_world : s.motion.keyframes().front().pose * s.to_world);
  for (const uint32_t segment : placed.segments) {
    const Segment p = spline_of(placed, segment);
    if (!is_linear(p)) lose("the width of a curve changes steadily along each of its segments");
    std::vector<float> points;
    for (const TubePoint& t : p)
      for (const float x : {t.position.x, t.position.y, t.position.z}) points.push_back(x);
    Statement curve("Shape", "curve");
    curve.string("type", c.profile == CurveProfile::ribbon ? "flat" : "cylinder");
    curve.string("basis", "bspline").list<float>("P", Type::point3, points);
    curve.number("width0", width(p, 0)).number("width1", width(p, 1));
    if (alpha != FloatInput(1.0)) put(curve, "alpha", alpha);
    world_text_ += curve.text();
  }
}

}  // namespace duet::pbrt
