#include "integrators/method_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/percent.h"
#include "integrators/group_pilot.h"
#include "integrators/merge_parts.h"
#include "integrators/method_candidates.h"
#include "integrators/method_groups.h"
#include "integrators/method_risk.h"
#include "integrators/method_rules.h"
#include "integrators/sample_budget.h"

namespace duet {

namespace {

/// Share of the render's cost that the pilot may have, and what one of its eye sub-paths costs in
/// samples of path tracing.
constexpr double kPilotShare = 0.04, kPilotSubpathCost = 14;
constexpr int kFewestPixels = 16, kMostPixels = 64;  ///< per side
/// How much better than path tracing a method has to be: that gains more from Sobol' points.
constexpr double kHysteresis = 1.2;
/// And one that merges than all that do not: those gain more from Sobol' points, and are unbiased.
constexpr double kMergingHysteresis = 1.3;
/// Probability that another method is so much better above which the choice is not sure.
constexpr double kDoubt = 0.1;
/// Share of the image above which merging in a part of it is merging in all of it.
constexpr double kNearlyAll = 0.95;
/// Share of the light that may be missed.
constexpr double kNegligible = 1e-4;
/// Share of the light that may be in so few pixels that an image looks as if it were missing.
constexpr double kMostRare = 0.02;

/// What a method is taken for before anything is known of it: for the length of the pilot.
PredictedMethod unknown_method() {
  PredictedMethod p;
  p.variance = p.cost = 1;
  return p;
}

/// Adds what comes of merging in parts of the image only, for the candidates that merge.
void add_partly_merged(MethodPrices& prices) {
  const size_t count = prices.candidates.size();
  for (size_t with = 0; with < count; ++with)
    for (size_t without = 0; without < count; ++without) {
      MethodCandidate c = prices.candidates[with];
      const MethodCandidate& plain = prices.candidates[without];
      if (c.merges == 0 || c.photons_only || plain.merges > 0 || in_pixel_groups(plain) ||
          plain.light_paths != c.light_paths || plain.connections != c.connections)
        continue;
      PartlyMerged part =
          merge_where_it_pays(prices.predictions[without], prices.predictions[with]);
      if (part.share == 0 || part.share > kNearlyAll) continue;
      std::get<BidirectionalIntegratorDescription>(c.method).merge_parts = std::move(part.parts);
      c.name += fmt::format(", merging in {:.0f} % of the image", 100 * part.share);
      prices.candidates.push_back(std::move(c));
      prices.predictions.push_back(std::move(part.prediction));
    }
}

/// What the pilots have found.
struct PilotRecords {
  PricingRecord record;
  std::optional<GroupGains> groups;
};

/// For a number of samples, which those of the batches add up to.
MethodPrices predict_all(const PilotRecords& pilots, const Scene& scene, const PathLimits& o,
                         int spp, int batches) {
  const PricingRecord& record = pilots.record;
  MethodPrices prices;
  prices.candidates = method_candidates(scene, o, std::max(1, spp / batches));
  prices.subpaths = record.subpaths();
  prices.spp = spp;
  for (const MethodCandidate& c : prices.candidates)
    prices.predictions.push_back(predict(record, c, spp));
  if (pilots.groups) add_pixel_groups(record, *pilots.groups, prices);
  return prices;
}

const PredictedMethod& cheapest(const MethodPrices& prices) {
  return *std::min_element(prices.predictions.begin(), prices.predictions.end(),
                           [](const PredictedMethod& a, const PredictedMethod& b) {
                             return a.error * a.cost < b.error * b.cost;
                           });
}

/// The choice where nothing is tried; `why` is one line.
MethodChoice without_pilot(const MethodRules& rules, const PathLimits& o, const std::string& why) {
  const MethodCandidate c = camera_candidate(rules, o);
  return {c.method, c.name + ": " + why, ""};
}

/// Why a candidate may not be taken: it misses light, has it in few pixels, or starts at the camera
/// where light has to be found from its source.
enum class Flaw : uint8_t { none, misses, rare, one_sided };

/// Which of the candidates may be taken.
struct Eligible {
  std::vector<Flaw> flaws;
  std::vector<uint8_t> candidates;  ///< 1 for those without a flaw
  bool unbiased = false;            ///< there is one among them that does not merge
};

Eligible eligible(const MethodPrices& prices, const MethodRules& rules) {
  const std::vector<MethodCandidate>& c = prices.candidates;
  const std::vector<PredictedMethod>& p = prices.predictions;
  // Shares of the light that the best of them misses, and has in few pixels.
  double least_missing = 1, least_rare = 1;
  const auto can_find_all = [&](size_t i) {
    return !(rules.needs_light_subpaths && c[i].light_paths == 0);
  };
  for (size_t i = 0; i < c.size(); ++i)
    if (can_find_all(i)) least_missing = std::min(least_missing, p[i].missing);
  const auto misses = [&](size_t i) { return p[i].missing > least_missing + kNegligible; };
  // Light that a method misses is not rare with it: those that miss some are no measure.
  for (size_t i = 0; i < c.size(); ++i)
    if (can_find_all(i) && !misses(i)) least_rare = std::min(least_rare, p[i].rare);
  Eligible result;
  for (size_t i = 0; i < c.size(); ++i) {
    const Flaw flaw = misses(i)                            ? Flaw::misses
                      : p[i].rare > least_rare + kMostRare ? Flaw::rare
                      : !can_find_all(i)                   ? Flaw::one_sided
                                                           : Flaw::none;
    result.flaws.push_back(flaw);
    result.candidates.push_back(flaw == Flaw::none);
    result.unbiased |= flaw == Flaw::none && c[i].merges == 0;
  }
  return result;
}

/// What is wrong with a candidate.
std::string why_not(const PredictedMethod& p, Flaw flaw) {
  if (flaw == Flaw::misses) return fmt::format(" would miss {} of the light", percent(p.missing));
  if (flaw == Flaw::rare)
    return fmt::format(" would show {} of the light in fewer than {} of the pixels",
                       percent(p.rare), percent(kTrimmedPixels));
  return " cannot find all light";
}

/// The candidate with which least is to be lost; one that does not merge, and path tracing, unless
/// they lose more.
size_t least_loss(const MethodPrices& prices, const std::vector<uint8_t>& may,
                  const MethodRisk& risk) {
  const std::vector<MethodCandidate>& c = prices.candidates;
  size_t best = c.size(), unbiased = c.size();
  for (size_t i = 0; i < c.size(); ++i) {
    const auto improves = [&](size_t on) {
      return may[i] && (on == c.size() || risk.loss(i) < risk.loss(on));
    };
    if (improves(best)) best = i;
    if (c[i].merges == 0 && improves(unbiased)) unbiased = i;
  }
  if (unbiased < c.size() && !(risk.loss(unbiased) > kMergingHysteresis * risk.loss(best)))
    best = unbiased;
  return may[0] && !(risk.loss(0) > kHysteresis * risk.loss(best)) ? 0 : best;
}

/// What each candidate promises, a line each.
std::vector<std::string> promises(const MethodPrices& prices, const MethodRisk& risk) {
  std::vector<std::string> lines;
  for (size_t i = 0; i < prices.candidates.size(); ++i) {
    const PredictedMethod& p = prices.predictions[i];
    lines.push_back(
        fmt::format("auto: {:36} misses {:.2e}, rare {:.3f}, merges {:.3f}, variance {:.3g}, "
                    "blur² {:.3g}, error² {:.3g}, cost {:.3g}, price {:.3g}, loss {:.3g}",
                    prices.candidates[i].name, p.missing, p.rare, p.merged, p.variance, p.blur,
                    p.error, p.cost, p.error * p.cost, risk.loss(i)));
  }
  return lines;
}

}  // namespace

MethodPrices price_methods(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook, const PilotChoice& pilot) {
  const int guess = expected_samples(outlook, unknown_method());
  PricingPlan plan{options, outlook.film};
  plan.threads = outlook.threads;
  plan.seed = pilot.seed;
  plan.pixels_per_side = pilot.pixels_per_side;
  if (plan.pixels_per_side == 0) {
    const double samples = double(outlook.film.x) * outlook.film.y * guess;
    const double pixels = kPilotShare * samples / (2 * kPilotSubpathCost);
    plan.pixels_per_side = std::clamp(int(std::sqrt(pixels)), kFewestPixels, kMostPixels);
  }
  PilotRecords pilots{run_pricing_pilot(scene, plan), std::nullopt};
  if (suits_pixel_groups(scene, options)) pilots.groups = measure_pixel_groups(scene, plan);
  MethodPrices prices = predict_all(pilots, scene, options, guess, outlook.batches);
  if (outlook.seconds || outlook.target_error)
    prices = predict_all(pilots, scene, options, expected_samples(outlook, cheapest(prices)),
                         outlook.batches);
  add_partly_merged(prices);
  return prices;
}

MethodChoice take(const MethodPrices& prices, const MethodRules& rules) {
  const Eligible may = eligible(prices, rules);
  const MethodRisk risk(prices.predictions, may.candidates);
  const size_t best = least_loss(prices, may.candidates, risk);
  const MethodCandidate &c = prices.candidates[best], &from_camera = prices.candidates[0];
  const PredictedMethod &p = prices.predictions[best], &path = prices.predictions[0];
  MethodChoice choice;
  choice.method = c.method;
  choice.candidates = promises(prices, risk);
  choice.reason = c.name + ": ";
  if (!may.candidates[0])
    choice.reason += from_camera.name + why_not(path, may.flaws[0]);
  else if (best == 0)
    choice.reason +=
        fmt::format("no other method promises more than {} times its efficiency", kHysteresis);
  else
    choice.reason +=
        fmt::format("{} times the efficiency of {}",
                    ratio(path.error * path.cost / p.error / p.cost), from_camera.name);
  choice.reason += fmt::format(", by a pilot of {} eye sub-paths", prices.subpaths);
  if (risk.doubt(best, kHysteresis) > kDoubt)
    choice.reason += fmt::format(
        ", too short to be sure: the choice is what loses least if it is wrong, {} times the "
        "work of the best in one of five cases",
        ratio(risk.loss(best)));
  choice.reason += "; " + describe(rules);
  if (c.merges > 0) {
    choice.bias =
        may.unbiased
            ? "merging is consistent, but biased"
            : "some light is found by merging only, or in few pixels: consistent, but biased";
    choice.reason += "; consistent, biased";
  }
  return choice;
}

MethodChoice choose_method(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook) {
  const MethodRules rules = method_rules(scene.features);
  const auto no_pilot = [&](const char* why) { return without_pilot(rules, options, why); };
  if (!rules.has_lights) return no_pilot("the scene has no lights");
  const Obstacle obstacle = obstacle_to_light_subpaths(scene, options);
  if (obstacle == Obstacle::one_way_surfaces)
    return no_pilot("light cannot be followed through tubes from its source");
  if (obstacle == Obstacle::emissive_media)
    return no_pilot("no light sub-paths start in media that emit");
  if (options.max_depth >= 0 && options.max_depth < 2)
    return no_pilot("paths of one segment are seen directly");
  if (!scene.camera->connectible())
    return no_pilot("the sensor cannot be connected with light sub-paths");

  return take(price_methods(scene, options, outlook), rules);
}

}  // namespace duet
