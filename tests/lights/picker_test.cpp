#include "lights/picker.h"

#include <doctest/doctest.h>

#include <numeric>

#include "lights/delta.h"
#include "lights/environment.h"

using namespace duet;

namespace {

struct FewLights {
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<double> factors;
  void point(float intensity, double factor = 1) {
    lights.push_back(std::make_unique<PointEmitter>(Point3f(0, 0, 0), Spectrum(intensity)));
    factors.push_back(factor);
  }
  void sky(float radiance) {
    lights.push_back(std::make_unique<ConstantEnvironment>(Spectrum(radiance)));
    factors.push_back(1);
  }
  /// Normalised weights.
  std::vector<float> shares(double radius) const {
    std::vector<float> w = selection_weights(lights, factors, radius);
    const float sum = std::accumulate(w.begin(), w.end(), 0.0f);
    for (float& v : w) v /= sum;
    return w;
  }
};

}  // namespace

TEST_CASE("lights are chosen by power, but none that shines is forgotten") {
  FewLights l;
  for (const float i : {6.0f, 3.0f, 1.0f, 0.0f}) l.point(i);
  const auto w = l.shares(1);
  for (size_t i = 0; i < 3; ++i) {
    const float power[] = {0.6f, 0.3f, 0.1f};
    CHECK(w[i] == doctest::Approx(0.5 * double(power[i]) + 0.5 / 3));
  }
  CHECK(w[3] == 0);
  const LightPicker picker(w);
  CHECK(picker.size() == 4);
  float sum = 0;
  for (uint32_t i = 0; i < 4; ++i) sum += picker.probability(i);
  CHECK(sum == doctest::Approx(1));
  for (int i = 0; i < 1000; ++i) {
    const auto pick = picker.pick((float(i) + 0.5f) / 1000, {});
    CHECK(pick.probability == picker.probability(pick.light));
    CHECK(pick.light < 3);
  }
}

TEST_CASE("a factor multiplies the share of a light") {
  FewLights a, b;
  for (int i = 0; i < 3; ++i) a.point(2), b.point(2, i == 0 ? 4 : i);
  const auto w = b.shares(1);
  CHECK(w[0] == doctest::Approx(4.0 / 7));
  CHECK(w[1] == doctest::Approx(1.0 / 7));
  CHECK(w[2] == doctest::Approx(2.0 / 7));
  CHECK(a.shares(1)[0] == doctest::Approx(1.0 / 3));
}

TEST_CASE("neither near nor infinitely far lights starve each other") {
  FewLights l;
  l.point(1), l.point(1), l.sky(1);
  for (const double radius : {1e-3, 0.8, 1e3}) {
    const auto w = l.shares(radius);
    CHECK(w[2] == doctest::Approx(0.25 + 0.5 / 3));
    CHECK(w[0] == doctest::Approx(0.125 + 0.5 / 3));
    CHECK(w[1] == w[0]);
  }
}

TEST_CASE("lights that are all dark, or alone, can still be picked") {
  FewLights dark;
  dark.point(0), dark.point(0);
  const LightPicker two(selection_weights(dark.lights, dark.factors, 1));
  CHECK(two.probability(0) == doctest::Approx(0.5));
  FewLights one;
  one.point(0);
  const LightPicker alone(selection_weights(one.lights, one.factors, 1));
  CHECK(alone.probability(0) == 1);
  CHECK(alone.pick(0.7f, {}).light == 0);
  CHECK(LightPicker(std::vector<float>{}).size() == 0);
}
