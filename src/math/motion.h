// Affine maps that change with time.
#pragma once

#include <vector>

#include "base/boxed.h"
#include "math/transform.h"

namespace duet {

/// Where something is at one time.
struct Keyframe {
  double time = 0;
  Matrix4 pose;
  bool operator==(const Keyframe&) const = default;
};

/// The way through some poses: from one to the next translations and stretches change linearly and
/// rotations steadily, by the shorter way. Before the first and after the last nothing changes.
/// Source: Shoemake & Duff, "Matrix Animation and Polar Decomposition", Graphics Interface 1992.
class Motion {
 public:
  /// Stands still where it is.
  Motion() = default;
  /// The poses are affine and can be inverted, and all of them mirror or none does, so that all
  /// poses between them can be inverted, too. Their times increase.
  explicit Motion(std::vector<Keyframe> keyframes);

  bool empty() const { return !way_; }
  const std::vector<Keyframe>& keyframes() const;
  /// The identity if there are no poses; at their times exactly the poses.
  Matrix4 at(double time) const;
  /// Whether the pose is the same at all times from `first` to `last`.
  bool is_still(double first, double last) const;

  bool operator==(const Motion& o) const { return keyframes() == o.keyframes(); }

 private:
  /// A pose taken apart.
  struct Parts {
    std::array<double, 3> translation;
    std::array<double, 4> rotation;  ///< a unit quaternion: x, y, z and the real part
    std::array<std::array<double, 3>, 3> stretch;
  };
  static Parts parts(const Matrix4& pose);
  static Matrix4 between(const Parts& a, const Parts& b, double share);

  /// The poses, and the same taken apart.
  struct Way {
    std::vector<Keyframe> keyframes;
    std::vector<Parts> parts;
  };

  Boxed<Way> way_;  ///< few things move
};

}  // namespace duet
