// Reads clouds of ellipsoids from PLY files, as volumetric primitives are stored.
#pragma once

#include <string>
#include <vector>

#include "math/transform.h"
#include "mesh/byte_reader.h"

namespace duet {

struct Ellipsoid {
  double center[3];
  double radius[3];      ///< along its own axes
  double quaternion[4];  ///< i, j, k, real; of length one
};

/// The vertices of the file's first element: x, y, z, the logarithms of the radii scale_0 …
/// scale_2, and the rotation rot_0 (real) … rot_3. Throws ReadError "file: message" if one is
/// missing or not finite.
std::vector<Ellipsoid> read_ellipsoids(const std::string& file);
/// The same for an opened file.
std::vector<Ellipsoid> parse_ellipsoids(ByteReader& in);

/// Where Mitsuba puts the unit sphere for each of them, with the radii multiplied by `scale`:
/// stretches of `to_world` are evened out.
std::vector<Matrix4> ellipsoid_places(const std::vector<Ellipsoid>& all, double scale,
                                      const Matrix4& to_world);

}  // namespace duet
