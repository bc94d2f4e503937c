// Where in a texture a point of space lies.
#pragma once

#include "math/transform.h"
#include "math/vector.h"
#include "textures/texture_kinds.h"

namespace duet {

/// A point in the space of a texture, to which an affine map leads that need not have an inverse.
class SpaceMap {
 public:
  SpaceMap() = default;
  explicit SpaceMap(const Matrix4& from_world) {
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 4; ++j) rows_[i][j] = float(from_world.m[i][j]);
  }
  Point3f operator()(const Point3f& p) const { return {row(0, p), row(1, p), row(2, p)}; }

 private:
  float row(size_t i, const Point3f& p) const {
    return rows_[i][0] * p.x + rows_[i][1] * p.y + rows_[i][2] * p.z + rows_[i][3];
  }
  float rows_[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

/// `p` is given in the texture's space.
inline Point2f texture_coordinates(SpaceMapKind kind, const Point3f& p) {
  switch (kind) {
    case SpaceMapKind::spherical: {
      const float length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
      const float cosine = length > 0 ? std::clamp(p.z / length, -1.0f, 1.0f) : 1.0f;
      const float turns = std::atan2(p.y, p.x) * (0.5f * kInvPi);
      return {std::acos(cosine) * kInvPi, turns < 0 ? turns + 1 : turns};
    }
    case SpaceMapKind::cylindrical:
      return {0.5f + std::atan2(p.y, p.x) * (0.5f * kInvPi), p.z};
    case SpaceMapKind::planar:
      return {p.x, p.y};
  }
  __builtin_unreachable();
}

}  // namespace duet
