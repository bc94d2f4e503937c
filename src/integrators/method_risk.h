// How sure a pilot's prices are, and what a choice by them may lose.
#pragma once

#include <vector>

#include "integrators/method_prediction.h"

namespace duet {

/// What is to be feared of taking each of several methods. The parts of the image fall into groups
/// that cover it evenly, and prices as they could be are those of the groups with random weights.
/// Source: Rubin, "The Bayesian Bootstrap", The Annals of Statistics 9(1), 1981. The weights have
/// twice the variance of his: prices have heavy tails, and a pilot that has met few of the rare
/// contributions also believes them to be certain.
class MethodRisk {
 public:
  /// `eligible` is not zero for the methods that may be taken; there is at least one.
  MethodRisk(const std::vector<PredictedMethod>& predictions, const std::vector<uint8_t>& eligible);

  /// The method's price (error² · cost) over the least of all that are eligible, as it is exceeded
  /// in one of five draws: 1 for a method that is hardly ever worse than another.
  double loss(size_t method) const;
  /// Share of the draws in which some other eligible method has less than the method's price over
  /// `factor`.
  double doubt(size_t method, double factor) const;

 private:
  /// By method: its price over the least of each draw, in rising order.
  std::vector<std::vector<double>> ratios_;
};

}  // namespace duet
