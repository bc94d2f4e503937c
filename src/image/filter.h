// Reconstruction filters: how much a sample at some distance counts for a pixel.
#pragma once

#include <array>

namespace duet {

enum class FilterKind { box, tent, gaussian, mitchell, catmullrom, lanczos };

/// A filter by name with its parameters, in pixels. Which parameter means what follows Mitsuba:
/// `radius` is the half width of the box and of the tent, `stddev` the gaussian's, `lobes` that of
/// lanczos, `b` and `c` the coefficients of Mitchell & Netravali.
struct FilterDescription {
  FilterKind kind = FilterKind::gaussian;
  double radius = 0.5;
  double stddev = 0.5;
  double b = 1.0 / 3, c = 1.0 / 3;
  int lobes = 3;
  bool operator==(const FilterDescription&) const = default;
};

/// A separable filter, tabulated: weight(dx) · weight(dy).
class ReconstructionFilter {
 public:
  explicit ReconstructionFilter(const FilterDescription& description);

  /// Half width in pixels; the weight is zero at and beyond it.
  float radius() const { return radius_; }
  /// How many pixels beyond its own a sample can reach.
  int border() const { return border_; }
  /// True if each sample counts for its own pixel alone, with weight 1.
  bool is_unit_box() const { return is_unit_box_; }

  float weight(float distance) const {
    const float x = (distance < 0 ? -distance : distance) * scale_;
    const int i = int(x);
    if (i >= kResolution) return 0;
    const float f = x - float(i);
    return table_[i] * (1 - f) + table_[i + 1] * f;
  }

 private:
  static constexpr int kResolution = 512;
  std::array<float, kResolution + 1> table_;
  float radius_, scale_;
  int border_;
  bool is_unit_box_;
};

/// The filter's value at a distance from its centre, from its formula.
double evaluate_filter(const FilterDescription& description, double distance);
/// Half width of the filter in pixels.
double filter_radius(const FilterDescription& description);

}  // namespace duet
