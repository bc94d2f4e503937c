// Surfaces given by heights on a grid, as triangle meshes.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace duet {

/// Heights at the corners of a grid over the square from (−1, −1) to (1, 1), in rows from y = −1;
/// at least two along either side. Between four of them the surface is a bilinear patch.
struct HeightField {
  int columns = 0, rows = 0;
  std::vector<float> heights;  ///< rows × columns
  /// Normals at the corners are the mean of those of the patches around them, as Mitsuba 0.6
  /// weighs them: each of length one in a space whose cells have sides of length one. Otherwise the
  /// surface has an edge between any two patches.
  bool shading_normals = true;
};

/// Facing +z, with texture coordinates from (0, 0) at (−1, −1) to (1, 1). Patches become n × n
/// squares of two triangles, where n is a power of two, the same everywhere so that nothing gapes.
/// A patch with heights f00, f10, f01, f11 lies no further than |f00 − f10 − f01 + f11| / (4 n²)
/// above or below them; n is the least with which that is at most 1/512 of the difference between
/// the greatest and the least height, or the last before the mesh exceeds 2²⁰ triangles.
TriangleMesh make_height_field(const HeightField& field);

}  // namespace duet
