// A material as it was measured.
#pragma once

#include <memory>

#include "materials/measured_table.h"
#include "materials/model.h"
#include "math/vector.h"

namespace duet {

/// A family of densities over the unit square, bilinear between the nodes of a grid, by two
/// parameters between which they are interpolated.
class WarpGrid {
 public:
  /// As many grids as there are pairs of parameters, the second fastest; values are not negative.
  WarpGrid(const MeasuredTable::Grid& grid, const std::vector<float>& first,
           const std::vector<float>& second);

  /// Four grids and their weights.
  struct Mix {
    uint32_t grid[4];
    float weight[4];
  };
  Mix mix(float first, float second) const;

  /// From a uniform point to one with the density of the mix.
  Point2f sample(const Mix& mix, const Point2f& u, float& density) const;
  /// The way back.
  Point2f invert(const Mix& mix, const Point2f& p, float& density) const;
  float density(const Mix& mix, const Point2f& p) const;

 private:
  float value(const Mix& mix, const std::vector<float>& table, size_t stride, size_t index) const;
  uint32_t width_, height_;
  const std::vector<float>&first_, &second_;
  std::vector<float> values_;   ///< normalised
  std::vector<float> rows_;     ///< sums along x, per node row
  std::vector<float> columns_;  ///< sums of whole rows along y
};

/// The tables made ready for rendering; what the model points to.
class MeasuredBrdf {
 public:
  explicit MeasuredBrdf(std::shared_ptr<const MeasuredTable> table);

  ModelEval eval(const Vector3f& wo, const Vector3f& wi) const;
  /// The direction only.
  std::optional<Vector3f> sample(const Vector3f& wo, const Point2f& v) const;

 private:
  std::shared_ptr<const MeasuredTable> table_;
  WarpGrid vndf_, luminance_;
  bool isotropic_;
  int reduction_;  ///< by symmetry, the share of the full turn that was measured is 1 / this
};

/// Reflection on the upper side. Made for radiance: for importance the two directions and their
/// cosines are exchanged.
struct MeasuredModel {
  const MeasuredBrdf* brdf;

  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return false; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;
};

}  // namespace duet
