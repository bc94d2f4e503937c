// The opening of a lens system's stop.
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace duet {

/// The openings that have a name in pbrt, and those of an image.
enum class StopShape { disk, gaussian, square, pentagon, star, image };
inline constexpr std::string_view kStopShapes[] = {"disk",     "gaussian", "square",
                                                   "pentagon", "star",     "image"};

/// How much light passes the points of a square that is two units wide, with the stop's rim as the
/// unit circle in it. The mean over the square is that of the disk, π/4: shapes do not change the
/// brightness.
class LensStop {
 public:
  /// A disk.
  LensStop() = default;
  /// A shape other than an image.
  explicit LensStop(StopShape shape);
  /// What passes is proportional to values in rows from the top, +y; between their centres it is
  /// interpolated, and it is zero around the image. None is negative, and not all are zero.
  LensStop(int width, int height, std::vector<float> values);

  /// At a point, with +x to the right of the image that the camera takes.
  double transmission(double x, double y) const;
  /// No light passes farther from the centre.
  double reach() const;

 private:
  bool inside_outline(double x, double y) const;
  double texel(int x, int y) const;

  StopShape shape_ = StopShape::disk;
  double scale_ = 1;
  std::vector<std::array<double, 2>> outline_;  ///< the corners of a polygon
  int width_ = 0, height_ = 0;
  std::vector<float> values_;
};

}  // namespace duet
