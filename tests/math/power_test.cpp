#include "math/power.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "math/hash.h"
#include "math/statistics.h"

using namespace duet;

namespace {

/// A normal variate, by Box & Muller's transform.
struct Normal {
  uint32_t state = 1;
  double uniform() { return (double(mix32(state++)) + 0.5) / 4294967296.0; }
  double operator()() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(6.283185307179586 * uniform());
  }
};

}  // namespace

TEST_CASE("a planted difference of the size that is stated is noticed in 95 % of the trials") {
  Normal normal;
  for (const int count : {16, 64, 256})
    for (const double level : {1e-6, 1e-3}) {
      CAPTURE(count);
      CAPTURE(level);
      // Values of deviation 1 on one side, of 0.5 on the other, which has twice as many.
      const MeanEstimate a{0, 1.0 / count, count}, b{0, 0.25 / (2 * count), 2 * count};
      const WelchTest known = welch_test(a, b);
      const double planted = noticed_difference(known.error, known.dof, level);
      constexpr int kTrials = 1500;
      int noticed = 0, by_chance = 0;
      for (int i = 0; i < kTrials; ++i) {
        Moments subject, reference;
        for (int n = 0; n < count; ++n) subject.add(normal());
        for (int n = 0; n < 2 * count; ++n) reference.add(0.5 * normal());
        MeanEstimate off = subject.estimate();
        by_chance += welch_test(off, reference.estimate()).p <= level;
        off.mean += planted;
        noticed += welch_test(off, reference.estimate()).p <= level;
      }
      // Five standard deviations of the number noticed are 2.8 %.
      CHECK(std::abs(double(noticed) / kTrials - kPowerShare) < 0.028);
      CHECK(by_chance <= 8);
    }
}

TEST_CASE("a value beyond a limit by as much as is stated is found beyond it") {
  Normal normal;
  for (const int count : {8, 64}) {
    CAPTURE(count);
    int found = 0;
    constexpr int kTrials = 4000;
    for (int i = 0; i < kTrials; ++i) {
      Moments m;
      for (int n = 0; n < count; ++n) m.add(normal());
      // What is stated depends on the error that is measured.
      found += m.mean() + noticed_excess(m.error(), count - 1) > 0;
    }
    CHECK(std::abs(double(found) / kTrials - kPowerShare) < 0.018);
  }
}

TEST_CASE("no noise, no difference that goes unnoticed") {
  CHECK(noticed_difference(0, 10, 1e-6) == 0);
  CHECK(noticed_excess(0, 10) == 0);
  // Many degrees of freedom: normal quantiles.
  CHECK(noticed_difference(2, 1e9, 0.05) == doctest::Approx(2 * (1.959964 + 1.644854)));
}

TEST_CASE("the jackknife gives the standard error of a mean") {
  const std::vector<double> values{1, 4, 2, 8, 5, 7};
  Moments all;
  for (const double v : values) all.add(v);
  const auto without = [&](int g) {
    Moments m;
    for (int i = 0; i < int(values.size()); ++i)
      if (i != g) m.add(values[size_t(i)]);
    return m.mean();
  };
  CHECK(jackknife_error(int(values.size()), without) == doctest::Approx(all.error()));
}
