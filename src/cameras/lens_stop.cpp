#include "cameras/lens_stop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/angles.h"

namespace duet {

namespace {

/// A polygon with corners at these distances from the centre in turn, the first one at `start`
/// degrees.
std::vector<std::array<double, 2>> polygon(const std::vector<double>& distances, double start) {
  std::vector<std::array<double, 2>> corners;
  const double step = 360 / double(distances.size());
  for (size_t i = 0; i < distances.size(); ++i) {
    const double angle = (start + step * double(i)) * kRadians;
    corners.push_back({distances[i] * std::cos(angle), distances[i] * std::sin(angle)});
  }
  return corners;
}

double polygon_area(const std::vector<std::array<double, 2>>& corners) {
  double twice = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

LensStop::LensStop(StopShape shape) : shape_(shape) {
  switch (shape) {
    case StopShape::disk:
    case StopShape::image:
      return;
    case StopShape::gaussian:
      // The mean of exp(-r²) - exp(-1) over the unit disk.
      scale_ = 1 / (1 - 2 * std::exp(-1.0));
      return;
    case StopShape::square:
      outline_ = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
      break;
    case StopShape::pentagon:
      outline_ = polygon({0.8, 0.8, 0.8, 0.8, 0.8}, -90);
      break;
    case StopShape::star: {
      const double inner = std::cos(72 * kRadians) / std::cos(36 * kRadians);
      outline_ = polygon({inner, 1, inner, 1, inner, 1, inner, 1, inner, 1}, 0);
      break;
    }
  }
  scale_ = std::numbers::pi / polygon_area(outline_);
}

LensStop::LensStop(int width, int height, std::vector<float> values)
    : shape_(StopShape::image), width_(width), height_(height), values_(std::move(values)) {
  double sum = 0;
  for (const float v : values_) sum += double(v);
  scale_ = 0.25 * std::numbers::pi * double(values_.size()) / sum;
}

double LensStop::reach() const {
  if (shape_ != StopShape::image) return 1;
  // The corners of the square, and the half texels around it.
  return std::numbers::sqrt2 * (1 + 1 / double(std::min(width_, height_)));
}

inline bool LensStop::inside_outline(double x, double y) const {
  // The winding number is odd or even: no outline crosses itself.
  bool inside = false;
  for (size_t i = 0, j = outline_.size() - 1; i < outline_.size(); j = i++) {
    const auto &a = outline_[i], &b = outline_[j];
    if ((a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0])
      inside = !inside;
  }
  return inside;
}

inline double LensStop::texel(int x, int y) const {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
  return double(values_[size_t(y) * size_t(width_) + size_t(x)]);
}

double LensStop::transmission(double x, double y) const {
  const double r2 = x * x + y * y;
  switch (shape_) {
    case StopShape::disk:
      return r2 <= 1 ? 1 : 0;
    case StopShape::gaussian:
      return scale_ * std::max(0.0, std::exp(-r2) - std::exp(-1.0));
    case StopShape::image: {
      const double u = 0.5 * (x + 1) * width_ - 0.5, v = 0.5 * (1 - y) * height_ - 0.5;
      if (!(u > -1 && v > -1 && u < width_ && v < height_)) return 0;
      const int i = int(std::floor(u)), j = int(std::floor(v));
      const double du = u - i, dv = v - j;
      return scale_ * ((1 - dv) * ((1 - du) * texel(i, j) + du * texel(i + 1, j)) +
                       dv * ((1 - du) * texel(i, j + 1) + du * texel(i + 1, j + 1)));
    }
    default:
      return inside_outline(x, y) ? scale_ : 0;
  }
}

}  // namespace duet
