// Reconstruction filters: how much a sample at some distance counts for a pixel.
#pragma once

#include <optional>

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
  /// Half widths along x and y where they are not what follows from the other parameters: box, tent
  /// and Mitchell's and Catmull and Rom's filters are stretched to them, the others end there, and
  /// the Gaussian is lowered so that it is zero there. This is how pbrt has them.
  std::optional<double> reach_x = std::nullopt, reach_y = std::nullopt;
  bool operator==(const FilterDescription&) const = default;
};

/// A filter along one axis, tabulated.
class FilterProfile {
 public:
  /// `reach` is FilterDescription's along this axis.
  FilterProfile(const FilterDescription& description, const std::optional<double>& reach);

  /// Half width in pixels; the weight is zero at and beyond it.
  float radius() const { return radius_; }
  float weight(float distance) const {
    const float x = (distance < 0 ? -distance : distance) * scale_;
    const int i = int(x);
    if (i >= kResolution) return 0;
    const float f = x - float(i);
    return table_[i] * (1 - f) + table_[i + 1] * f;
  }
  /// The same bits without a branch, for loops over many distances.
  float weight_in_lanes(float distance) const {
    const float x = (distance < 0 ? -distance : distance) * scale_;
    // Beyond the end there are zeros.
    const float in_table = x < float(kResolution) ? x : float(kResolution + 1);
    const int i = int(in_table);
    const float f = in_table - float(i);
    return table_[i] * (1 - f) + table_[i + 1] * f;
  }

 private:
  static constexpr int kResolution = 512;
  /// No std::array, whose indices are of 64 bits: compilers do not gather by such.
  float table_[kResolution + 3] = {};
  float radius_, scale_;
};

/// A separable filter: along_x().weight(dx) · along_y().weight(dy).
class ReconstructionFilter {
 public:
  explicit ReconstructionFilter(const FilterDescription& description);

  const FilterProfile& along_x() const { return along_x_; }
  const FilterProfile& along_y() const { return along_y_; }
  /// How many pixels beyond its own a sample can reach.
  int border() const { return border_; }
  /// True if each sample counts for its own pixel alone, with weight 1.
  bool is_unit_box() const { return is_unit_box_; }

 private:
  FilterProfile along_x_, along_y_;
  int border_;
  bool is_unit_box_;
};

/// The filter's value at a distance from its centre along an axis, from its formula; `reach` is
/// FilterDescription's along that axis.
double evaluate_filter(const FilterDescription& description, double distance,
                       const std::optional<double>& reach = std::nullopt);
/// Half width of the filter in pixels, without a reach.
double filter_radius(const FilterDescription& description);

}  // namespace duet
