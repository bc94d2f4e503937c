#include "integrators/merge_parts.h"

#include <algorithm>

#include "transport/merge_mask.h"

namespace duet {

namespace {

constexpr int kSide = MergeMask::kSide;
/// Each pass decides by the totals of the one before; they settle quickly.
constexpr int kPasses = 4;

struct Around {
  double missing = 0, error = 0;
};

/// The means over a part and those beside it.
Around around(const std::vector<PredictedPart>& parts, int x, int y) {
  Around sum;
  double count = 0;
  for (int j = std::max(0, y - 1); j <= std::min(kSide - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(kSide - 1, x + 1); ++i) {
      const PredictedPart& p = parts[size_t(j * kSide + i)];
      sum.missing += p.missing, sum.error += p.error;
      ++count;
    }
  return {sum.missing / count, sum.error / count};
}

}  // namespace

PartlyMerged merge_where_it_pays(const PredictedMethod& without, const PredictedMethod& with) {
  constexpr double kParts = double(kSide * kSide);
  PartlyMerged result{std::vector<uint8_t>(size_t(kParts), 1), 1, with};
  for (int pass = 0; pass < kPasses; ++pass) {
    // Turning a part off makes the error larger and the cost smaller.
    const double cheaper = (with.cost - without.cost) / kParts / result.prediction.cost;
    PredictedMethod mixed;
    double blur_variance = 0;
    std::vector<uint8_t> parts;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Around a = around(without.parts, x, y), b = around(with.parts, x, y);
        const bool merge =
            a.missing > b.missing || a.error - b.error > cheaper * result.prediction.error;
        const PredictedPart& p = (merge ? with : without).parts[parts.size()];
        parts.push_back(merge);
        mixed.missing += p.missing;
        mixed.rare += p.rare;
        mixed.merged += p.merged;
        mixed.variance += p.variance;
        mixed.blur += p.blur, blur_variance += p.blur_variance;
        mixed.error += p.error;
        mixed.parts.push_back(p);
      }
    result.share = double(std::count(parts.begin(), parts.end(), 1)) / kParts;
    result.parts = std::move(parts);
    mixed.cost = without.cost + result.share * (with.cost - without.cost);
    const double blur = cautious_blur(mixed.blur, blur_variance);
    mixed.error += blur - mixed.blur;
    mixed.blur = blur;
    // To take the smaller of two noisy figures in every part promises too much.
    mixed.error = std::max(mixed.error, std::min(with.error, without.error));
    result.prediction = std::move(mixed);
  }
  return result;
}

}  // namespace duet
