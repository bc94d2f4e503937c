// What the pilot says of methods that merge, against the spread of their images.
#include "integrators/method_prediction.h"

#include <cmath>

#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kSize = 64, kImages = 24;

/// Variance of one sample per pixel, relative to about what predictions are relative to.
double measured_variance(const TransportScene& s, const std::string& method,
                         const TransportScene::Parameters& parameters) {
  const size_t pixels = size_t(kSize) * kSize;
  std::vector<double> sums(pixels), squares(pixels);
  for (uint64_t seed = 0; seed < kImages; ++seed) {
    const Image image = s.render(method, parameters, 1, seed).image;
    for (size_t i = 0; i < pixels; ++i) {
      const float* p = &image.data[i * image.channels.size()];
      const double v = double(p[0] + p[1] + p[2]) / 3;
      sums[i] += v, squares[i] += v * v;
    }
  }
  double mean = 0;
  for (const double v : sums) mean += v / kImages / double(pixels);
  std::vector<double> relative;
  for (size_t i = 0; i < pixels; ++i) {
    const double m = sums[i] / kImages;
    const double variance = (squares[i] / kImages - m * m) * kImages / (kImages - 1);
    relative.push_back(variance / (m * m + 0.1 * mean * mean));
  }
  std::sort(relative.begin(), relative.end());
  double sum = 0;
  for (size_t i = 0; i < pixels - pixels / 1000; ++i) sum += relative[i];
  return sum / double(pixels);
}

/// A look at every pixel, and at paths of so many segments.
PricingPlan plan_for(int max_depth) {
  PricingPlan plan;
  plan.film = {kSize, kSize};
  plan.pixels_per_side = kSize;
  plan.max_depth = max_depth;
  return plan;
}

MethodCandidate merging(bool photons_only) {
  return {.method = {},
          .name = "",
          .light_paths = 1,
          .connections = false,
          .merges = 1,
          .photons_only = photons_only};
}

}  // namespace

// Most light here is both merged and seen from the camera, by the same light vertices: were the two
// taken for independent, vcm would seem to have three quarters of the variance of ppm.
TEST_CASE("the variance of merging is foreseen, alone and beside light that the camera sees") {
  const TransportScene s("lamp-in-glass", kSize);
  PricingPlan plan = plan_for(8);
  const PricingRecord record = run_pricing_pilot(*s.scene, plan);
  const PredictedMethod photons = predict(record, merging(true), 1);
  const PredictedMethod vcm = predict(record, merging(false), 1);
  const double measured_photons = measured_variance(s, "ppm", {{"alpha", "1"}});
  const double measured_vcm =
      measured_variance(s, "vcm", {{"alpha", "1"}, {"light_paths", "1"}, {"connections", "0"}});
  CAPTURE(photons.variance);
  CAPTURE(vcm.variance);
  CAPTURE(measured_photons);
  CAPTURE(measured_vcm);
  CHECK(std::abs(std::log(photons.variance / measured_photons)) < std::log(1.4));
  CHECK(std::abs(std::log(vcm.variance / photons.variance * measured_photons / measured_vcm)) <
        std::log(1.25));
  CHECK(photons.merged == doctest::Approx(1).epsilon(1e-4));
  CHECK(vcm.merged > 0.5);
  CHECK(vcm.merged < 0.95);
  CHECK(photons.missing < 1e-6);
  CHECK(photons.cost < 0.6 * vcm.cost);
}

// The lamp's light samples and hits count for up to five in weights, not in the number of samples:
// taken for so many, path would seem to have a tenth of its variance. What is measured is relative
// to pixels, and so half as much again as what is relative to tiles.
TEST_CASE("the variance of direct light is foreseen") {
  const TransportScene s(camera_xml("0, -0.8, 1.4", "0, 0, 0", kSize) +
                         room_xml(grey("0.5, 0.5, 0.5")) + lamp_xml("0.3", "10") +
                         sphere_xml("-0.3, 0, 0.5", "0.3", grey("0.5, 0.5, 0.5")));
  PricingPlan plan = plan_for(2);
  const PricingRecord record = run_pricing_pilot(*s.scene, plan);
  for (const double light_paths : {0.0, 1.0}) {
    MethodCandidate candidate = merging(false);
    candidate.light_paths = light_paths, candidate.merges = 0;
    const double foreseen = predict(record, candidate, 1).variance;
    const double measured =
        light_paths > 0
            ? measured_variance(s, "bdpt",
                                {{"max_depth", "2"}, {"light_paths", "1"}, {"connections", "0"}})
            : measured_variance(s, "path", {{"max_depth", "2"}});
    CAPTURE(light_paths);
    CAPTURE(foreseen);
    CAPTURE(measured);
    CHECK(std::abs(std::log(foreseen / measured)) < std::log(1.8));
  }
}

// A small lamp makes edges of shadows that photons blur.
TEST_CASE("the blur of merging is foreseen") {
  const TransportScene s(camera_xml("0, -3, 1", "0, 0, 1", kSize) +
                         room_xml(grey("0.5, 0.5, 0.5")) + lamp_xml("0.05", "300") +
                         sphere_xml("-0.3, 0, 0.5", "0.3", grey("0.5, 0.5, 0.5")));
  PricingPlan plan = plan_for(3);
  // Of one pilot it is uncertain by half the value here.
  double foreseen = 0;
  constexpr int kPilots = 24;
  for (; plan.seed < kPilots; ++plan.seed)
    for (const PredictedPart& p :
         predict(run_pricing_pilot(*s.scene, plan), merging(true), 64).parts)
      foreseen += p.blur / kPilots;
  // The error of two means each, whose noise is independent.
  const size_t pixels = size_t(kSize) * kSize;
  std::vector<double> errors[2], truth(pixels);
  for (uint64_t k = 0; k < 2; ++k) {
    const Image a = s.render("ppm", {{"alpha", "1"}, {"max_depth", "3"}}, 128, k).image;
    const Image b = s.render("path", {{"max_depth", "3"}}, 128, k).image;
    for (size_t i = 0; i < pixels; ++i) {
      const size_t at = i * a.channels.size();
      errors[k].push_back(double(a.data[at]) - double(b.data[at]));
      truth[i] += double(b.data[at]) / 2;
    }
  }
  std::vector<double> tiles(16 * 16);
  const auto tile = [](size_t i) { return i / kSize / 4 * 16 + i % kSize / 4; };
  double mean = 0, measured = 0;
  for (size_t i = 0; i < pixels; ++i) {
    mean += truth[i] / double(pixels);
    tiles[tile(i)] += truth[i] / 16;
  }
  for (size_t i = 0; i < pixels; ++i) {
    const double v = std::max(truth[i], tiles[tile(i)]);
    measured += errors[0][i] * errors[1][i] / (v * v + 0.1 * mean * mean) / double(pixels);
  }
  CAPTURE(foreseen);
  CAPTURE(measured);
  CHECK(measured > 1e-4);
  CHECK(std::abs(std::log(foreseen / measured)) < std::log(2));
}

TEST_CASE("noise goes with the number of samples, blur stays") {
  const TransportScene s("thesis-modified", kSize);
  PricingPlan plan = plan_for(8);
  const PricingRecord record = run_pricing_pilot(*s.scene, plan);
  const PredictedMethod few = predict(record, merging(true), 64);
  const PredictedMethod many = predict(record, merging(true), 1 << 24);
  REQUIRE(few.blur > 0);
  CHECK(few.error / (few.variance / 64 + few.blur) == doctest::Approx(1).epsilon(0.025));
  CHECK(many.error / many.blur == doctest::Approx(1).epsilon(0.01));
  // With half the squared radius it has half the squared error.
  MethodCandidate shrunk = merging(true);
  shrunk.merges = 0.5;
  CHECK(predict(record, shrunk, 64).blur / few.blur == doctest::Approx(0.5).epsilon(0.1));
}

// A lamp above a screen, in fog: light samples reach next to nothing that is seen.
TEST_CASE("the variance of methods in fog is foreseen") {
  const TransportScene s(
      camera_xml("0, -3, 1", "0, 0, 1", kSize) + room_xml(grey("0.7, 0.7, 0.7")) +
      "<medium type='homogeneous' id='fog'><rgb name='sigma_t' value='0.3, 0.2, 0.1'/></medium>"
      "<shape type='cube'><transform name='to_world'><scale value='4'/></transform>"
      "<bsdf type='null'/><ref id='fog' name='interior'/></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='0.8'/>"
      "<translate z='1.7'/></transform>" +
      grey("0.5, 0.5, 0.5") + "</shape>" + lamp_xml("0.2", "60"));
  PricingPlan plan = plan_for(8);
  const PricingRecord record = run_pricing_pilot(*s.scene, plan);
  const MethodCandidate volpath{.method = {}, .name = ""};
  MethodCandidate bdpt = volpath;
  bdpt.light_paths = 1, bdpt.connections = true;
  MethodCandidate unconnected = bdpt;
  unconnected.connections = false;
  const auto check = [&](const MethodCandidate& candidate, const std::string& method,
                         TransportScene::Parameters parameters) {
    parameters.emplace_back("max_depth", "8");
    const double measured = measured_variance(s, method, parameters);
    // As many samples as the images have together, of which the rarest are left out.
    const double foreseen = predict(record, candidate, kImages).variance;
    CAPTURE(method);
    CAPTURE(measured);
    CAPTURE(foreseen);
    // Path tracing has ten times the variance of the others, and fireflies.
    CHECK(std::abs(std::log(foreseen / measured)) < std::log(2));
  };
  check(volpath, "volpath", {});
  check(bdpt, "bdpt", {{"light_paths", "1"}});
  check(unconnected, "bdpt", {{"light_paths", "1"}, {"connections", "0"}});
}

TEST_CASE("the work of methods in grids is foreseen") {
  const TransportScene s("media-heterogeneous", kSize);
  PricingPlan plan;
  plan.film = s.layout.full;
  plan.pixels_per_side = 64;
  plan.max_depth = 8;
  const PricingRecord record = run_pricing_pilot(*s.scene, plan);
  const auto steps = [&](const std::string& method, TransportScene::Parameters parameters) {
    parameters.emplace_back("max_depth", "8");
    const RenderCounters c = s.render(method, parameters, 2, 1).counters;
    return double(c.medium_steps) / double(c.camera_paths);
  };
  const double subpaths = double(record.subpaths());
  const double eye = double(record.eye_counters.medium_steps) / subpaths,
               light = double(record.light_counters.medium_steps) / subpaths,
               connections = double(record.connection_counters.medium_steps) / subpaths;
  CHECK(eye > 3);
  CHECK(connections > 0.5);
  CHECK(eye == doctest::Approx(steps("volpath", {})).epsilon(0.15));
  CHECK(eye + light ==
        doctest::Approx(steps("bdpt", {{"light_paths", "1"}, {"connections", "0"}})).epsilon(0.15));
  CHECK(eye + light + connections ==
        doctest::Approx(steps("bdpt", {{"light_paths", "1"}})).epsilon(0.25));
  const MethodCandidate volpath{.method = {}, .name = ""};
  MethodCandidate bdpt = volpath;
  bdpt.light_paths = 1, bdpt.connections = true;
  CHECK(predict(record, bdpt, 1).cost >
        predict(record, volpath, 1).cost + 0.04 * (light + connections));
}
