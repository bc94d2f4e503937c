#include "integrators/sample_budget.h"

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

constexpr double kMostExpected = 1e6;  ///< more samples make no difference to any choice

}  // namespace

int expected_samples(const RenderOutlook& outlook, const PredictedMethod& method) {
  double samples = outlook.spp > 0 ? double(outlook.spp) : kMostExpected;
  if (outlook.seconds) {
    const double pixels = double(outlook.film.x) * outlook.film.y;
    samples = std::min(samples, *outlook.seconds * outlook.threads /
                                    (pixels * std::max(method.cost, 1e-3) * 1e-6));
  }
  if (outlook.target_error)
    samples = std::min(samples, method.variance / (*outlook.target_error * *outlook.target_error));
  return int(std::clamp(std::round(samples), 1.0, kMostExpected));
}

}  // namespace duet
