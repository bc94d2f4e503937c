// A cloud that is made of noise.
#pragma once

#include "media/volume.h"

namespace duet {

/// Where in its own space the cloud is, and what it looks like.
struct CloudShape {
  Point3f lower{0.0f}, upper{1.0f};  ///< a box outside of which there is nothing
  float density = 1;                 ///< multiplies the noise
  float wispiness = 1;               ///< how far the noise is displaced by further noise
  float frequency = 5;               ///< of the noise
};

/// Extinction that follows noise of five octaves and thins out with height along +y: below 1/2 the
/// cloud gets denser, at 1 it ends. Used in place of a GridVolume. pbrt-v4 has it, after T. Elsner.
class CloudVolume {
 public:
  /// `extinction` is where the cloud is densest.
  CloudVolume(const CloudShape& shape, const Spectrum& extinction, const Matrix4& to_world);

  int channels() const;
  Point3f to_local(const Point3f& p) const { return to_world_.inverse(p); }
  Vector3f to_local(const Vector3f& v) const { return to_world_.inverse(v); }
  /// The share of the extinction at a point of the cloud's own space, in [0, 1].
  float density(const Point3f& p) const;
  float local_value(const Point3f& p) const { return extinction_.r * density(p); }
  Spectrum local_color(const Point3f& p) const { return extinction_ * density(p); }
  /// As GridVolume's.
  void world_box(Point3f& lower, Point3f& upper) const;
  float maximum(const Point3f& lower, const Point3f& upper) const;
  /// No finer bounds are known than one for all.
  static constexpr std::array<int, 3> resolution() { return {1, 1, 1}; }

 private:
  CloudShape shape_;
  Spectrum extinction_;
  Transform to_world_;
};

}  // namespace duet
