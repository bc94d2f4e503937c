// Thin round tubes around lines through space: hair, fur, grass, cables.
#pragma once

#include <cstdint>
#include <vector>

#include "math/transform.h"
#include "math/vector.h"

namespace duet {

/// A point that a curve goes through (linear) or that pulls at it (B-spline), with the radius of
/// the tube there. Control points of B-splines may have negative radii where the tube narrows so
/// quickly that it would end before its last point.
struct TubePoint {
  Point3f position;
  float radius;
  bool operator==(const TubePoint&) const = default;
};

enum class CurveKind : uint8_t {
  linear,   ///< straight cones with a sphere at each point
  bspline,  ///< uniform cubic B-splines with open ends; positions and radii are interpolated alike
};

/// What the radius of a curve makes of it. Ribbons are pbrt's: they face each ray, so the curve has
/// no surface that would be the same for all of them.
enum class CurveProfile : uint8_t {
  tube,
  ribbon,        ///< its normal is as close to the ray as the curve allows (B-splines only)
  round_ribbon,  ///< its normal turns by half a circle across it, as that of a tube nearly does
};

/// Many curves, as segments between neighbouring points.
struct CurveSet {
  CurveKind kind = CurveKind::linear;
  CurveProfile profile = CurveProfile::tube;
  std::vector<TubePoint> points;
  /// The first of the 2 (linear) or 4 (B-spline) points of each segment.
  std::vector<uint32_t> segments;
  /// Rays see tubes only from outside: one that starts within leaves without a hit.
  bool outside_only = true;
  bool operator==(const CurveSet&) const = default;
};

/// The number of points that a curve needs at least.
inline constexpr uint32_t points_per_segment(CurveKind kind) {
  return kind == CurveKind::linear ? 2 : 4;
}

/// Moves the points to where `to_world` puts them. Radii stay as they are, as in Mitsuba.
void transform_curves(CurveSet& curves, const Matrix4& to_world);

/// The middle of a tube, with derivatives by the segment's own parameter.
struct CurveCenter {
  Point3f position;
  Vector3f first, second;
  float radius, radius_slope;
};
/// At the parameter u ∈ [0, 1] of a segment.
CurveCenter curve_center(const CurveSet& curves, uint32_t segment, float u);

}  // namespace duet
