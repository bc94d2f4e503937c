// Shapes as they are rendered: triangle meshes in world space, and surfaces given by formulas.
#pragma once

#include <cstdint>
#include <memory>

#include "geometry/curves.h"
#include "geometry/mesh.h"
#include "geometry/sdf_grid.h"
#include "math/measure.h"
#include "math/transform.h"

namespace duet {

enum class ShapeKind : uint8_t {
  mesh,
  sphere,    ///< unit sphere around the origin
  disk,      ///< unit disk in the plane z = 0, facing +z
  cylinder,  ///< radius 1 around the z axis, from z = 0 to 1, facing outwards, without caps
  sdf_grid,  ///< see sdf_grid.h: in the unit cube
  curves,    ///< see curves.h: in world space
};

/// What the materials and lights on a surface ask of a hit. What is not needed is not computed.
struct SurfaceNeeds {
  bool uv = false;        ///< texture coordinates
  bool tangents = false;  ///< dp/du and dp/dv, and a shading frame aligned with them
  SurfaceNeeds operator|(const SurfaceNeeds& o) const {
    return {uv || o.uv, tangents || o.tangents};
  }
};

/// An unsigned index that may be absent.
inline constexpr uint32_t kNone = ~0u;

/// One surface of the scene with what is attached to it. Analytic shapes may be stretched and
/// mirrored by any invertible affine transform.
struct Shape {
  ShapeKind kind = ShapeKind::mesh;
  /// Turns the surface inside out. For meshes and analytic shapes alike.
  bool flip_normals = false;
  SurfaceNeeds needs;
  uint32_t material = kNone;
  uint32_t light = kNone;
  /// Media behind and before the surface, if it separates any.
  uint32_t interior = kNone, exterior = kNone;

  std::shared_ptr<const TriangleMesh> mesh;  ///< in world space; for meshes only
  std::shared_ptr<const SdfGrid> sdf;
  std::shared_ptr<const CurveSet> curves;
  Transform to_world;  ///< for analytic shapes only
  Matrix4 to_local;    ///< its inverse in double precision

  /// Into how many parts an analytic shape is divided to be found by rays.
  uint32_t analytic_parts() const {
    return kind == ShapeKind::sdf_grid ? uint32_t(sdf->cells.size()) : 1;
  }
  bool separates_media() const { return (interior & exterior) != kNone; }
};

/// An affine copy of a group of shapes.
struct Instance {
  uint32_t group = 0;
  Transform to_world;
  /// Largest stretch of the transform, for bounds on rounding errors.
  float scale = 1;
};

/// Consecutive shapes that are placed together by instances.
struct ShapeRange {
  uint32_t first = 0, count = 0;
};

/// Where a ray met the scene. (u, v) are barycentric coordinates on triangles (weights of the
/// second and third vertex); on curves u runs along the segment. Unused on analytic shapes.
struct Hit {
  float t, u, v;
  uint32_t primitive;
  uint32_t shape;
  uint32_t instance;  ///< kNone outside of instances
};

/// The distance of the nearest intersection of a ray with a part of an analytic shape in
/// (tnear, ray.tmax), or INFINITY. Works in double precision and on directions of any length, in
/// units of theirs.
double analytic_distance(const Shape& shape, uint32_t part, const Ray& ray, double tnear);

/// Lower and upper corner of an analytic shape's box in world space.
struct Bounds {
  Point3f lower{INFINITY}, upper{-INFINITY};
  void extend(const Point3f& p);
  void extend(const Bounds& b) { extend(b.lower), extend(b.upper); }
  bool empty() const { return !(lower.x <= upper.x); }
  Point3f center() const { return empty() ? Point3f(0) : lower + (upper - lower) * 0.5f; }
  /// Radius of a sphere around the centre that contains the box.
  float radius() const { return empty() ? 0.0f : 0.5f * length(upper - lower); }
};
Bounds analytic_bounds(const Shape& shape);
/// The same of one of its parts.
Bounds analytic_bounds(const Shape& shape, uint32_t part);
Bounds curve_bounds(const CurveSet& curves);

/// A point of a shape, chosen or parametrised by a uniform pair of numbers.
struct ShapePoint {
  Point3f position;
  /// Unit geometric normal, turned to the side of the shading normal.
  Normal3f ng;
  /// Unit shading normal: light leaves on its side.
  Normal3f ns;
  Point2f uv;        ///< if the shape needs uv
  float offset = 0;  ///< as in Surface
  PdfA pdf;
  Point2f barycentric;     ///< as in Surface, on meshes
  uint32_t primitive = 0;  ///< on meshes
};

/// The point of triangle `primitive` with these weights of its second and third vertex. `pdf` is
/// one over the triangle's area.
ShapePoint point_on_triangle(const Shape& shape, uint32_t primitive, const Point2f& barycentric);
/// A point of triangle `primitive`, uniform over its area, with its `pdf`.
ShapePoint sample_triangle(const Shape& shape, uint32_t primitive, const Point2f& u);
/// A point of an analytic shape; `pdf` is exact also where a stretched shape makes it uneven.
ShapePoint sample_analytic(const Shape& shape, const Point2f& u);
/// Whether an analytic surface faces the other way than the transformed normal of the unit shape. A
/// sphere mirrored by its transform is inside out, the other shapes are not; so it is in Mitsuba.
bool faces_inwards(const Shape& shape);
/// Texture coordinates of a point of the unit shape.
Point2f analytic_uv(ShapeKind kind, const Point3f& local);
/// The density with which sample_analytic makes the point whose normal in the shape's own space is
/// `local_normal` (unit length).
PdfA pdf_analytic(const Shape& shape, const Normal3f& local_normal);
/// World-space surface area per area of the unit shape at a point with this local normal.
float area_stretch(const Shape& shape, const Normal3f& local_normal);

float triangle_area(const TriangleMesh& mesh, uint32_t primitive);
/// Total area; of a stretched sphere or cylinder by numerical integration to about six digits.
double surface_area(const Shape& shape);

}  // namespace duet
