#include "integrators/method_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "integrators/method_costs.h"

namespace duet {

namespace {

/// Of the least price of `bdpt` without groups, what that with them may be: a smaller gain cannot
/// be told from none.
constexpr double kMostOfPrice = 0.85;
/// How much larger the variance of `path` may be than that of `bdpt`: beyond that it is that of
/// paths which `bdpt` finds in other ways, and what groups make of it says nothing about `bdpt`.
constexpr double kMostVariance = 16;

/// The variance that `path` would have without what groups share.
double unshared_variance(const PricingRecord& record, const MethodPrices& prices) {
  MethodCandidate path = prices.candidates[0];
  path.shared_variance = 0;
  return predict(record, path, prices.spp).variance;
}

/// MethodCandidate::shared_variance, from the variance of `path` and that without what is shared.
double shared_variance(const GroupGain& gain, double all, double unshared) {
  if (!(all > unshared)) return 1;
  const double ratio = (gain.variance * all - unshared) / (all - unshared);
  return std::clamp(ratio, 1 / double(gain.members), 1.0);
}

void add_path(const GroupGain& gain, MethodPrices& prices) {
  auto method = std::get<PathIntegratorDescription>(prices.candidates[0].method);
  method.pixel_group = gain.members;
  PredictedMethod p = prices.predictions[0];
  const double noise = p.variance / prices.spp;
  p.error += noise * (gain.variance - 1);
  p.variance *= gain.variance;
  p.cost += pixel_group_cost(gain.shadow_rays);
  for (PredictedPart& part : p.parts) {
    part.error += part.variance / prices.spp * (gain.variance - 1);
    part.variance *= gain.variance, part.least_error *= gain.variance;
  }
  prices.candidates.push_back(
      {.method = method, .name = fmt::format("path pixel_group={}", gain.members)});
  prices.predictions.push_back(std::move(p));
}

/// Of the first `count` candidates those that are `bdpt`; `unshared` is the variance of `path`
/// without what groups share.
void add_bdpt(const PricingRecord& record, const GroupGain& gain, double unshared, size_t count,
              MethodPrices& prices) {
  const auto price = [](const PredictedMethod& p) { return p.error * p.cost; };
  const double shared = shared_variance(gain, prices.predictions[0].variance, unshared);
  MethodPrices grouped;
  double least = INFINITY, least_grouped = INFINITY;
  for (size_t i = 1; i < count; ++i) {
    MethodCandidate c = prices.candidates[i];
    if (c.light_paths == 0 || c.merges > 0) continue;
    if (prices.predictions[0].variance > kMostVariance * prices.predictions[i].variance) continue;
    std::get<BidirectionalIntegratorDescription>(c.method).pixel_group = gain.members;
    c.shared_variance = shared;
    c.name += fmt::format(" pixel_group={}", gain.members);
    PredictedMethod p = predict(record, c, prices.spp);
    p.cost += pixel_group_cost(gain.shadow_rays);
    least = std::min(least, price(prices.predictions[i]));
    least_grouped = std::min(least_grouped, price(p));
    grouped.candidates.push_back(std::move(c));
    grouped.predictions.push_back(std::move(p));
  }
  if (!(least_grouped < kMostOfPrice * least)) return;
  std::move(grouped.candidates.begin(), grouped.candidates.end(),
            std::back_inserter(prices.candidates));
  std::move(grouped.predictions.begin(), grouped.predictions.end(),
            std::back_inserter(prices.predictions));
}

}  // namespace

void add_pixel_groups(const PricingRecord& record, const GroupGains& gains, MethodPrices& prices) {
  const size_t count = prices.candidates.size();
  const double unshared = record.batches ? unshared_variance(record, prices) : 0;
  for (const GroupGain& gain : gains) {
    add_path(gain, prices);
    if (record.batches) add_bdpt(record, gain, unshared, count, prices);
  }
}

bool in_pixel_groups(const MethodCandidate& c) {
  const auto* const d = std::get_if<BidirectionalIntegratorDescription>(&c.method);
  return d && d->pixel_group > 1;
}

}  // namespace duet
