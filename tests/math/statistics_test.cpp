#include "math/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "support/show.h"

using namespace duet;

namespace {

Moments moments(std::initializer_list<double> values) {
  Moments m;
  for (const double v : values) m.add(v);
  return m;
}

}  // namespace

TEST_CASE("normal quantiles invert p-values") {
  CHECK(normal_quantile(0.05) == doctest::Approx(1.959964));
  CHECK(normal_quantile(sidak(0.01, 64)) == doctest::Approx(3.781).epsilon(0.001));
  CHECK(normal_p_value(normal_quantile(1e-9)) == doctest::Approx(1e-9));
}

TEST_CASE("Student's t as a normal variate") {
  // Two-sided quantiles of Student's distribution from tables.
  for (const auto& [dof, p, t] :
       {std::tuple(5.0, 0.05, 2.570582), std::tuple(5.0, 0.001, 6.868827),
        std::tuple(15.0, 0.01, 2.946713), std::tuple(30.0, 0.001, 3.645959)}) {
    SHOW(dof);
    CHECK(normal_of_student(t, dof) == doctest::Approx(normal_quantile(p)).epsilon(1e-4));
    CHECK(student_of_normal(normal_of_student(t, dof), dof) == doctest::Approx(t));
  }
}

TEST_CASE("Welch's test") {
  // The numbers are those of scipy.stats.ttest_ind(a, b, equal_var=False).
  const Moments a = moments({1.0, 2.0, 3.0, 4.0, 5.0}), b = moments({2.5, 3.8, 4.2, 5.9, 7.7});
  const WelchTest w = welch_test(a.estimate(), b.estimate());
  CHECK(w.t == doctest::Approx(-1.588082).epsilon(1e-4));
  CHECK(w.dof == doctest::Approx(7.569033).epsilon(1e-3));
  CHECK(w.p == doctest::Approx(0.153072).epsilon(1e-4));
  CHECK(welch_test(moments({1, 1}).estimate(), moments({1, 1}).estimate()).p == 1);
  CHECK(welch_test(moments({1, 1}).estimate(), moments({2, 2}).estimate()).p == 0);
}

TEST_CASE("Student's distribution has its known tails") {
  CHECK(student_p_value(12.7062, 1) == doctest::Approx(0.05).epsilon(1e-4));
  CHECK(student_p_value(2.77645, 4) == doctest::Approx(0.05).epsilon(1e-4));
  CHECK(student_p_value(2.75, 30) == doctest::Approx(0.01).epsilon(1e-3));
  CHECK(student_p_value(0.3, 1.7) == doctest::Approx(0.7968029).epsilon(1e-6));
  CHECK(student_p_value(6, 15) == doctest::Approx(2.4326546e-5).epsilon(1e-6));
  CHECK(student_p_value(-6, 15) == student_p_value(6, 15));
  CHECK(student_p_value(1.959964, 1e6) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(student_p_value(0, 3) == doctest::Approx(1));
  // With many degrees of freedom it is the normal distribution, on both sides of the change.
  for (const double dof : {0.9e8, 1.1e8, 1e15, std::numeric_limits<double>::infinity()}) {
    CAPTURE(dof);
    CHECK(student_p_value(4, dof) == doctest::Approx(normal_p_value(4)).epsilon(1e-5));
    CHECK(student_p_value(0.5, dof) == doctest::Approx(normal_p_value(0.5)).epsilon(1e-5));
  }
}

TEST_CASE("means and their errors") {
  const MeanEstimate e = estimate_mean(std::vector<double>{1, 2, 3, 6});
  CHECK(e.mean == 3);
  CHECK(e.error2 == doctest::Approx(14.0 / 12));
  CHECK(e.count == 4);
  CHECK(estimate_mean({}).count == 0);
}

TEST_CASE("Welch's test: p-values of equal means are uniform, those of unequal ones small") {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 1);
  const auto sample = [&](int n, double deviation) {
    std::vector<double> v;
    for (int i = 0; i < n; ++i) v.push_back(5 + deviation * noise(generator));
    return estimate_mean(v);
  };
  int below[2] = {};
  constexpr int kTrials = 20000;
  for (int i = 0; i < kTrials; ++i) {
    const double p = welch_test(sample(8, 1), sample(16, 3)).p;
    below[0] += p < 0.01, below[1] += p < 0.5;
  }
  CHECK(std::abs(below[0] - 0.01 * kTrials) < 70);
  CHECK(std::abs(below[1] - 0.5 * kTrials) < 350);
  const MeanEstimate a{1, 1e-4, 16}, b{1.1, 1e-4, 16};
  CHECK(welch_test(a, b).p < 1e-5);
  CHECK(welch_test(a, b, 0.09).p == doctest::Approx(welch_test({0, 1e-4, 16}, {0.01, 1e-4, 16}).p));
  CHECK(welch_test(a, b, 0.2).p == 1);
  CHECK(welch_test({1, 0, 1}, {1, 0, 1}).p == 1);
  CHECK(welch_test({1, 0, 1}, {1.5, 0, 1}).p == 0);
  CHECK(welch_test({NAN, 1, 4}, a).p == 0);
  // A constant against a mean whose variance is known: no degrees of freedom are to be counted.
  CHECK(welch_test({1, 0, 16}, {1.1, 0.01, 0}).p == doctest::Approx(normal_p_value(1)));
  CHECK(welch_test({1, 1e-4, 16}, {1.1, 0, 0}).p ==
        doctest::Approx(student_p_value(10, 15)).epsilon(1e-6));
}

TEST_CASE("levels of many tests") {
  CHECK(1 - std::pow(1 - sidak(0.01, 64), 64) == doctest::Approx(0.01));
  CHECK(sidak(0.05, 1) == doctest::Approx(0.05));
}

TEST_CASE("the upper tail of the chi-square distribution") {
  // Abramowitz & Stegun, table 26.8.
  CHECK(chi_square_p_value(6.63490, 1) == doctest::Approx(0.01).epsilon(1e-5));
  CHECK(chi_square_p_value(0.0157908, 1) == doctest::Approx(0.9).epsilon(1e-4));
  CHECK(chi_square_p_value(20.5150, 8) == doctest::Approx(0.0086).epsilon(0.002));
  CHECK(chi_square_p_value(124.342, 100) == doctest::Approx(0.05).epsilon(1e-4));
  // With two degrees of freedom it is exponential.
  for (const double x : {0.1, 1.0, 3.0, 10.0, 100.0})
    CHECK(chi_square_p_value(x, 2) == doctest::Approx(std::exp(-x / 2)));
  CHECK(chi_square_p_value(0, 3) == 1);
  CHECK(chi_square_p_value(1e12, 3) == 0);
}

TEST_CASE("Sidak's correction and its inverse") {
  for (const double n : {1.0, 10.0, 198.0})
    CHECK(sidak_p_value(sidak(0.01, n), n) == doctest::Approx(0.01));
  CHECK(sidak_p_value(1, 10) == 1);
  CHECK(sidak_p_value(0, 10) == 0);
}
