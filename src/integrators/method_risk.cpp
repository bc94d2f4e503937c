#include "integrators/method_risk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/hash.h"
#include "math/vector.h"
#include "transport/merge_mask.h"

namespace duet {

namespace {

/// Groups are the parts at the same place of a square of this side.
constexpr int kLattice = 4;
constexpr size_t kGroups = size_t(kLattice * kLattice);
constexpr size_t kDraws = 256;
constexpr uint64_t kSeed = 0x7269736bull;

struct GroupSums {
  double error = 0, least = 0;
};

std::array<GroupSums, kGroups> group_sums(const PredictedMethod& p) {
  std::array<GroupSums, kGroups> sums{};
  for (size_t i = 0; i < p.parts.size(); ++i) {
    const size_t x = i % MergeMask::kSide % kLattice, y = i / MergeMask::kSide % kLattice;
    GroupSums& s = sums[y * kLattice + x];
    s.error += p.parts[i].error, s.least += p.parts[i].least_error;
  }
  return sums;
}

using Weights = std::array<double, kGroups>;

/// Of a draw: Dirichlet with all parameters 1/2, up to a factor.
Weights draw(size_t number) {
  Weights weights;
  uint64_t random = hash_combine(kSeed, number);
  for (double& w : weights) {
    // Half the square of a normal number.
    const double angle = 2 * kPi * double(to_unit_float(uint32_t(random)));
    w = -std::log(1 - double(to_unit_float(uint32_t(random >> 32)))) * std::pow(std::cos(angle), 2);
    random = mix64(random + 0x9e3779b97f4a7c15ull);
  }
  return weights;
}

/// Of a method in a draw.
double price(const PredictedMethod& p, const std::array<GroupSums, kGroups>& groups,
             const Weights& weights) {
  GroupSums all, drawn;
  double scale = 0;
  for (size_t g = 0; g < kGroups; ++g) {
    scale += weights[g] / double(kGroups);
    all.error += groups[g].error, all.least += groups[g].least;
    drawn.error += weights[g] * groups[g].error, drawn.least += weights[g] * groups[g].least;
  }
  const double whole = scale * std::max(all.error, all.least);
  if (!(whole > 0)) return p.error * p.cost;
  // The error of the whole may be larger than the sum of its parts (merge_where_it_pays).
  return p.error * p.cost * std::max(drawn.error, drawn.least) / whole;
}

}  // namespace

MethodRisk::MethodRisk(const std::vector<PredictedMethod>& predictions,
                       const std::vector<uint8_t>& eligible)
    : ratios_(predictions.size(), std::vector<double>(kDraws)) {
  std::vector<double> least(kDraws, std::numeric_limits<double>::infinity());
  for (size_t m = 0; m < predictions.size(); ++m) {
    const auto groups = group_sums(predictions[m]);
    for (size_t d = 0; d < kDraws; ++d) {
      // Even a method without any error has a price.
      ratios_[m][d] = std::max(price(predictions[m], groups, draw(d)), 1e-300);
      if (eligible[m]) least[d] = std::min(least[d], ratios_[m][d]);
    }
  }
  for (std::vector<double>& r : ratios_) {
    for (size_t d = 0; d < kDraws; ++d) r[d] /= least[d];
    std::sort(r.begin(), r.end());
  }
}

double MethodRisk::loss(size_t method) const {
  return ratios_[method][size_t(kDraws - kDraws / 5)];
}

double MethodRisk::doubt(size_t method, double factor) const {
  const std::vector<double>& r = ratios_[method];
  return double(r.end() - std::upper_bound(r.begin(), r.end(), factor)) / double(kDraws);
}

}  // namespace duet
