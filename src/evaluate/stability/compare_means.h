// Means of tiles, pixels or whole images against those of a reference.
// Source of the tests: Jung, Hanika & Dachsbacher, "Detecting Bias in Monte Carlo Renderers using
// Welch's t-test", JCGT 9(2), 2020.
#pragma once

#include <functional>
#include <vector>

#include "evaluate/stability/checks.h"

namespace duet::stability {

/// How means are compared.
struct Rule {
  double level;       ///< of significance, for one mean
  double margin;      ///< relative deviation that does not count
  double resolution;  ///< relative deviation that has to be noticed where there is no margin
  double coarser;     ///< see Cell
  double required() const { return margin > 0 ? std::max(2 * margin, resolution) : resolution; }
  double allowed_noise() const { return coarser * (required() - margin); }
};

/// The means of the tiles of each image, or whatever is compared.
using Means = std::function<std::vector<std::vector<double>>(const Series&)>;

/// Tiles of the subject against those of the reference.
struct GridComparison {
  double mean_z2 = 0;  ///< of the deviations as normal variates: about 1 if the means are equal
  double least_p = 1;  ///< of all tiles
  double rms = 0;      ///< of the deviations, relative to the mean, without the noise
  double ratio = 1;    ///< of the means of the images
  double error2 = 0;   ///< mean squared standard error of a tile, relative to the mean's square
  double error4 = 0;   ///< mean of its square
  Power power;         ///< of the least certain tile
};

/// The subject and the reference of a comparison.
struct Sides {
  std::vector<MeanEstimate> subject, reference;
};

std::vector<MeanEstimate> estimate_each(const std::vector<std::vector<double>>& batches);

GridComparison compare(const std::vector<MeanEstimate>& a, const std::vector<MeanEstimate>& b,
                       const Rule& rule);

/// The means of a series and of its reference, which is rendered with as many images as it needs.
/// What is wrong with the images of the reference is put down in `m`.
Sides both_sides(const Cell& cell, const Variant& v, const Series& subject, const Means& means,
                 const Rule& rule, Measurement& m);

/// The level of a test of one of so many means of each variant, and by how much they may be off.
Rule rule_of(const Cell& cell, const Series& subject, double means, double resolution);

}  // namespace duet::stability
