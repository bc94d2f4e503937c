// Corners of the triangles of a mesh, fetched for many points.
#pragma once

#include "geometry/shape.h"
#include "integrators/wide_state.h"

namespace duet {

/// What points of a mesh are made of. Large meshes are in no cache near by: corners are asked for
/// kAhead points ahead, and the numbers of the corners before that.
struct WideMesh {
  static constexpr int kAhead = 12;

  const Point3f* positions = nullptr;
  const std::array<uint32_t, 3>* triangles = nullptr;
  const Normal3f* normals = nullptr;  ///< or null
  float sign = 1;                     ///< −1 if the normals are to be turned

  WideMesh() = default;
  /// The mesh of the shape must stay where it is.
  explicit WideMesh(const Shape& shape)
      : positions(shape.mesh->positions.data()),
        triangles(shape.mesh->triangles.data()),
        normals(shape.mesh->normals.empty() ? nullptr : shape.mesh->normals.data()),
        sign(shape.flip_normals ? -1.0f : 1.0f) {}

  // Inlined, because g++ 12 drops calls of functions that do nothing but prefetch.
  [[gnu::always_inline]] void prefetch_triangle(uint32_t primitive) const {
    if (triangles) __builtin_prefetch(&triangles[primitive]);
  }
  [[gnu::always_inline]] void prefetch_corners(uint32_t primitive) const {
    if (!triangles) return;
    for (const uint32_t corner : triangles[primitive]) {
      __builtin_prefetch(&positions[corner]);
      if (normals) __builtin_prefetch(&normals[corner]);
    }
  }
  /// Sets element `i` of `out`.
  [[gnu::always_inline]] void get_corners(int i, uint32_t primitive, bool with_normals,
                                          WideTriangles& out) const {
    const std::array<uint32_t, 3>& t = triangles[primitive];
    out.sign[i] = sign;
    out.p0.set(i, positions[t[0]]);
    out.p1.set(i, positions[t[1]]);
    out.p2.set(i, positions[t[2]]);
    if (!with_normals) return;
    const Normal3f none(0);
    out.n0.set(i, normals ? normals[t[0]] : none);
    out.n1.set(i, normals ? normals[t[1]] : none);
    out.n2.set(i, normals ? normals[t[2]] : none);
  }
};

}  // namespace duet
