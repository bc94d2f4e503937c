// That prices which are not sure are known to be so, and that less is lost by that.
#include "integrators/method_risk.h"

#include <algorithm>
#include <cmath>

#include "integrators/method_choice.h"
#include "support/transport_scene.h"
#include "transport/merge_mask.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr size_t kParts = size_t(MergeMask::kSide * MergeMask::kSide);

/// A method of cost 1 whose error is that of the parts.
PredictedMethod method(const std::vector<double>& errors) {
  PredictedMethod p;
  p.cost = 1;
  for (const double e : errors) {
    p.parts.push_back({.error = e});
    p.error += e;
  }
  return p;
}

}  // namespace

TEST_CASE("the loss of even prices is their ratio, and that of uneven ones is larger") {
  std::vector<double> rare(kParts, 0.5);
  rare[37] += 0.55 * kParts;  // nearly all that makes it dearer has been met in one place
  const std::vector<PredictedMethod> methods{method(std::vector<double>(kParts, 1)),
                                             method(std::vector<double>(kParts, 1.3)), method(rare),
                                             method(std::vector<double>(kParts, 0.1))};
  const MethodRisk all(methods, {1, 1, 1, 0});
  const MethodRisk even(methods, {1, 1, 0, 0});
  CHECK(even.loss(0) == doctest::Approx(1));
  CHECK(even.loss(1) == doctest::Approx(1.3));
  CHECK(even.doubt(0, 1.15) == 0);
  CHECK(even.doubt(1, 1.15) == 1);
  CHECK(even.loss(3) == doctest::Approx(0.1));  // is not among those that may be taken
  // Its price is hardly higher, and may be half as high or twice.
  CHECK(methods[2].error == doctest::Approx(1.05 * kParts));
  CHECK(all.loss(2) > 1.3);
  CHECK(all.loss(0) > 1.3);
  CHECK(all.doubt(0, 1.15) > 0.3);
  CHECK(all.doubt(2, 1.15) > 0.1);
  CHECK(all.doubt(2, 1.15) < 0.7);
}

// Pilots of this length have met few of the rare contributions of path tracing, whose price looks
// lower than it is.
TEST_CASE("a short pilot takes what loses least, and says that it is short") {
  const TransportScene s("door-ajar", 64);
  const MethodRules rules = method_rules(s.scene->features);
  AutoIntegratorDescription options;
  options.max_depth = 8;
  const RenderOutlook outlook{s.layout.full, 8, 2};
  const auto price = [](const MethodPrices& p, const std::string& name) {
    double found = 0;
    for (size_t i = 0; i < p.candidates.size(); ++i)
      if (p.candidates[i].name == name) found = p.predictions[i].error * p.predictions[i].cost;
    return found;
  };
  const auto says_so = [](const MethodChoice& c) {
    return c.reason.find("too short to be sure") != std::string::npos;
  };
  std::vector<MethodPrices> known;
  for (uint64_t seed = 1000; seed < 1003; ++seed)
    known.push_back(price_methods(*s.scene, options, outlook, {64, seed}));
  const auto true_price = [&](const std::string& name) {
    double sum = 0;
    for (const MethodPrices& p : known) sum += price(p, name);
    return sum;
  };
  double least = INFINITY;
  for (const MethodCandidate& c : known[0].candidates) least = std::min(least, true_price(c.name));
  constexpr int kPilots = 12;
  double sum = 0;
  for (uint64_t seed = 0; seed < kPilots; ++seed) {
    const MethodPrices prices = price_methods(*s.scene, options, outlook, {0, seed});
    CHECK(prices.subpaths == 512);
    const MethodChoice c = take(prices, rules);
    sum += true_price(c.reason.substr(0, c.reason.find(':'))) / least;
  }
  CHECK(true_price("path") > 1.4 * least);
  CHECK(sum / kPilots < 1.1);
  // Pilots of nine pixels cannot always tell the best from others.
  int unsure = 0;
  for (uint64_t seed = 0; seed < 2 * kPilots; ++seed)
    unsure +=
        says_so(take(price_methods(*s.scene, options, {s.layout.full, 2, 2}, {3, seed}), rules));
  CHECK(unsure > 2);
  for (const MethodPrices& p : known) CHECK(!says_so(take(p, rules)));
}

// Light that a method misses is not rare with it, so that it is no measure of what is rare with
// others.
TEST_CASE("there is a method to take where one misses light and all others have it in few pixels") {
  MethodPrices prices;
  const auto add = [&](double light_paths, double missing, double rare, double error) {
    MethodCandidate c;
    c.method = PathIntegratorDescription{};
    c.name = light_paths > 0 ? "bdpt" : "path";
    c.light_paths = light_paths;
    prices.candidates.push_back(c);
    prices.predictions.push_back(method(std::vector<double>(kParts, error)));
    prices.predictions.back().missing = missing, prices.predictions.back().rare = rare;
  };
  add(0, 0.3, 0, 1);
  add(1, 0, 0.05, 2);
  add(0.25, 0, 0.06, 1.5);
  MethodChoice c = take(prices, {});
  CHECK(c.reason.find("bdpt: path would miss 30 % of the light") == 0);
  CHECK(c.candidates.size() == 3);
  prices.predictions[0] = method(std::vector<double>(kParts, 1));
  prices.predictions[0].rare = 0.08;
  c = take(prices, {});
  CHECK(c.reason.substr(0, 5) == "bdpt:");
  CHECK(c.reason.find("path would show 8 % of the light in fewer than 0.1 % of the pixels") !=
        std::string::npos);
}
