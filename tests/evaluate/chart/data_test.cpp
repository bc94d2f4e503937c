#include "evaluate/chart/data.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace duet;

namespace {

/// A line whose squared error is `error` / time, at 1, 2, 4 … seconds.
ChartLine line(const std::string& name, double error, int points = 8) {
  ChartLine l;
  l.name = name;
  for (int i = 0; i < points; ++i) {
    ChartPoint p;
    p.seconds = p.cpu_seconds = std::exp2(i);
    p.spp = 1 << i;
    p.mse = p.relmse = p.trimmed = error / p.seconds;
    for (int tile = 0; tile < 64; ++tile) {
      // Tiles differ by a tenth, which is what the interval is made of.
      p.tile_sums.push_back(p.trimmed * (tile % 2 == 0 ? 1.1 : 0.9));
      p.tile_pixels.push_back(1);
    }
    l.points.push_back(p);
  }
  fit(l);
  return l;
}

}  // namespace

TEST_CASE("efficiency is one over error and time, and the best is told from others") {
  ChartScene scene;
  scene.lines = {line("good", 0.01), line("bad", 0.04), ChartLine{}};
  REQUIRE(efficiency(scene.lines[0]));
  CHECK(efficiency(scene.lines[0])->value == doctest::Approx(100));
  CHECK(efficiency(scene.lines[1])->value == doctest::Approx(25));
  CHECK(!efficiency(scene.lines[2]));
  CHECK(best_efficiency(scene) == doctest::Approx(100));
  CHECK(most_efficient(scene) == std::vector<size_t>{0});
  CHECK(fastest(scene, 0.03) == std::vector<size_t>{0});
}

TEST_CASE("the time to an error lies on the line, beyond it or before it") {
  const ChartLine l = line("one", 0.01);  // errors of 0.1 after 1 s to 0.0088 after 128 s
  const auto between = time_to_error(l, 0.1 / std::sqrt(3.0));
  REQUIRE(between);
  CHECK(between->kind == TimeToError::interpolated);
  CHECK(between->cpu_seconds == doctest::Approx(3));
  CHECK(between->interval_95.low < 3);
  CHECK(between->interval_95.high > 3);
  const auto beyond = time_to_error(l, 0.1 / std::sqrt(1024.0));
  REQUIRE(beyond);
  CHECK(beyond->kind == TimeToError::extrapolated);
  CHECK(beyond->cpu_seconds == doctest::Approx(1024));
  CHECK(time_to_error(l, 0.2)->kind == TimeToError::at_most);
  CHECK(!time_to_error(ChartLine{}, 0.1));
}

TEST_CASE("errors for the table are round and within reach") {
  ChartScene scene;
  scene.lines = {line("one", 0.01)};
  const std::vector<double> errors = round_errors(scene);
  REQUIRE(errors.size() == 3);
  CHECK(errors[0] == doctest::Approx(0.05));
  CHECK(errors[1] == doctest::Approx(0.02));
  CHECK(errors[2] == doctest::Approx(0.01));
  CHECK(round_errors(ChartScene{}).empty());
}

TEST_CASE("tables of charts quote what a field may not hold") {
  ChartScene scene;
  scene.name = "a \"scene\", small";
  scene.lines = {line("vcm:radius=1,alpha=2", 0.01, 2)};
  CHECK(chart_csv(scene).find("\n\"vcm:radius=1,alpha=2\",1.0000,") != std::string::npos);
  CHECK(summary_csv({scene}).find("\n\"a \"\"scene\"\", small\",") != std::string::npos);
}
