#include "support/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/sampler.h"

namespace duet::test {

Chi2Result chi2_test(const std::vector<double>& observed, const std::vector<double>& expected,
                     double level) {
  std::vector<size_t> order(expected.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  Chi2Result r;
  double pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  const auto count = [&](double o, double e) {
    r.statistic += (o - e) * (o - e) / e;
    ++cells;
  };
  for (const size_t i : order) {
    if (expected[i] <= 0) {
      if (observed[i] > 0) {
        r.message = fmt::format("{} samples in cell {} of density zero", observed[i], i);
        return r;
      }
    } else if (expected[i] < 5 || (pooled_expected > 0 && pooled_expected < 5)) {
      pooled_observed += observed[i], pooled_expected += expected[i];
    } else {
      count(observed[i], expected[i]);
    }
  }
  if (pooled_expected > 0) count(pooled_observed, pooled_expected);
  r.dof = cells - 1;
  if (r.dof < 1) {
    r.message = "too few cells";
    return r;
  }
  r.p_value = chi_square_p_value(r.statistic, r.dof);
  r.pass = r.p_value > level;
  r.message =
      fmt::format("chi2 {:.1f}, {} degrees of freedom, p {:.3g}", r.statistic, r.dof, r.p_value);
  return r;
}

namespace {

/// Shared by both tests: cells of the unit square plus one for failed samples.
template <class SampleCell>
Chi2Result run(const SampleCell& sample_cell, const std::function<double(Point2f)>& density,
               const SquareTest& o) {
  const size_t cells = size_t(o.nx) * o.ny;
  std::vector<double> observed(cells + 1), expected(cells + 1);
  Sampler sampler(SampleSequence::independent, o.seed, 0, 0);
  for (int i = 0; i < o.samples; ++i) {
    sampler.start_sample(uint32_t(i));
    Point2f p{};
    if (!sample_cell(sampler, p)) {
      observed[cells] += 1;
      continue;
    }
    const int x = std::clamp(int(p.x * float(o.nx)), 0, o.nx - 1);
    const int y = std::clamp(int(p.y * float(o.ny)), 0, o.ny - 1);
    observed[size_t(y) * o.nx + x] += 1;
  }
  double mass = 0;
  for (int y = 0; y < o.ny; ++y)
    for (int x = 0; x < o.nx; ++x) {
      double sum = 0;
      for (int j = 0; j < o.sub; ++j)
        for (int i = 0; i < o.sub; ++i)
          sum += density({(float(x) + (float(i) + 0.5f) / float(o.sub)) / float(o.nx),
                          (float(y) + (float(j) + 0.5f) / float(o.sub)) / float(o.ny)});
      const double p = sum / (double(o.sub) * o.sub * cells);
      expected[size_t(y) * o.nx + x] = p * o.samples;
      mass += p;
    }
  if (mass > 1.01) {
    Chi2Result r;
    r.message = fmt::format("the density integrates to {}", mass);
    return r;
  }
  // Failed samples are whatever mass is missing; the integral's own error is no failure.
  if (observed[cells] > 0 || mass < 0.999) {
    expected[cells] = std::max(0.0, 1 - mass) * o.samples;
  } else {
    for (double& e : expected) e /= mass;
  }
  if (expected[cells] <= 0 && observed[cells] > 0) expected[cells] = 1e-9;
  return chi2_test(observed, expected, o.level);
}

}  // namespace

Chi2Result chi2_square(const std::function<bool(Point2f, Point2f&)>& sample,
                       const std::function<double(Point2f)>& density, const SquareTest& options) {
  return run([&](Sampler& s, Point2f& p) { return sample(s.next_2d(), p); }, density, options);
}

Chi2Result chi2_sphere(const std::function<bool(float, Point2f, Vector3f&)>& sample,
                       const std::function<double(const Vector3f&)>& density,
                       const SquareTest& options) {
  const auto to_direction = [](Point2f p) {
    const double phi = 2 * 3.14159265358979323846 * p.x, z = 1 - 2.0 * p.y;
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return Vector3f(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z));
  };
  return run(
      [&](Sampler& s, Point2f& p) {
        Vector3f d;
        const Point2f v = s.next_2d();
        if (!sample(s.next_1d(), v, d)) return false;
        const float phi = std::atan2(d.y, d.x) / (2 * kPi);
        p = {phi < 0 ? phi + 1 : phi, 0.5f * (1 - d.z)};
        return true;
      },
      [&](Point2f p) { return 4 * 3.14159265358979323846 * density(to_direction(p)); }, options);
}

}  // namespace duet::test
