#include "math/statistics.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <tuple>

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
    CAPTURE(dof);
    CHECK(normal_of_student(t, dof) == doctest::Approx(normal_quantile(p)).epsilon(0.01));
    CHECK(student_of_normal(normal_of_student(t, dof), dof) == doctest::Approx(t));
  }
}

TEST_CASE("Welch's test") {
  // The numbers are those of scipy.stats.ttest_ind(a, b, equal_var=False).
  const Moments a = moments({1.0, 2.0, 3.0, 4.0, 5.0}), b = moments({2.5, 3.8, 4.2, 5.9, 7.7});
  const WelchTest w = welch_test(a, b);
  CHECK(w.t == doctest::Approx(-1.588082).epsilon(1e-4));
  CHECK(w.dof == doctest::Approx(7.569033).epsilon(1e-3));
  CHECK(w.p == doctest::Approx(0.153072).epsilon(0.02));
  CHECK(welch_test(moments({1, 1}), moments({1, 1})).p == 1);
  CHECK(welch_test(moments({1, 1}), moments({2, 2})).p == 0);
}
