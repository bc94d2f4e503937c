#include "geometry/quadric.h"

#include "base/instruction_sets.h"

namespace duet {

namespace {

template <ShapeKind kind>
[[gnu::always_inline]] inline void fill_distances(const Matrix4& m, const RayLanes& rays,
                                                  unsigned n, float* t) {
  DUET_LANES
  for (unsigned i = 0; i < n; ++i) {
    const LocalVector o = to_local(m, double(rays.origin_x[i]), double(rays.origin_y[i]),
                                   double(rays.origin_z[i]), 1);
    const LocalVector d = to_local(m, double(rays.direction_x[i]), double(rays.direction_y[i]),
                                   double(rays.direction_z[i]), 0);
    t[i] = float(quadric_distance<kind>(o, d, double(rays.tnear[i]), double(rays.tfar[i])));
  }
}

DUET_WIDEST void sphere_distances(const Matrix4& m, const RayLanes& rays, unsigned n, float* t) {
  fill_distances<ShapeKind::sphere>(m, rays, n, t);
}

DUET_WIDEST void cylinder_distances(const Matrix4& m, const RayLanes& rays, unsigned n, float* t) {
  fill_distances<ShapeKind::cylinder>(m, rays, n, t);
}

DUET_WIDEST void disk_distances(const Matrix4& m, const RayLanes& rays, unsigned n, float* t) {
  fill_distances<ShapeKind::disk>(m, rays, n, t);
}

}  // namespace

void quadric_distances(const Shape& shape, const RayLanes& rays, unsigned n, float* t) {
  if (shape.kind == ShapeKind::sphere)
    sphere_distances(shape.to_local, rays, n, t);
  else if (shape.kind == ShapeKind::cylinder)
    cylinder_distances(shape.to_local, rays, n, t);
  else
    disk_distances(shape.to_local, rays, n, t);
}

}  // namespace duet
