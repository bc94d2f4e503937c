// How a surface bends.
#pragma once

#include "geometry/surface.h"

namespace duet {

/// In the space in which the shape stands, before instances place it. Where the surface bends away
/// from its shading normal, as a sphere does that faces outwards, the mean curvature is negative.
struct Curvature {
  float mean = 0;      ///< (κ₁ + κ₂) / 2, per unit of length
  float gaussian = 0;  ///< κ₁ κ₂
};

/// Whether curvature_at() knows shapes of this kind.
inline bool has_curvature(ShapeKind kind) {
  return kind != ShapeKind::curves && kind != ShapeKind::sdf_grid;
}

/// Exact on spheres, cylinders and disks, however stretched. On meshes from how the interpolated
/// normal turns over a triangle: zero without normals. Reads the primitive and the barycentric
/// coordinates of meshes, the uv of the others.
Curvature curvature_at(const Surface& s);

/// ∂n/∂u and ∂n/∂v of the shading normal, along the surface's dp_du and dp_dv, which it must have;
/// of interpolated normals that of the sum that is not normalised, as in pbrt. Zero on curves and
/// signed distance fields.
struct NormalDerivatives {
  Vector3f du{0}, dv{0};
};
NormalDerivatives normal_derivatives(const Surface& s);

}  // namespace duet
