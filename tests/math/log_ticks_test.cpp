#include "math/log_ticks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace duet;

namespace {

std::vector<std::string> labels(double low, double high) {
  std::vector<std::string> list;
  for (const Tick& t : log_ticks(low, high))
    if (t.labelled) list.push_back(tick_text(t.value));
  return list;
}

}  // namespace

TEST_CASE("every axis has three labels and no crowd") {
  for (double span = 2; span < 1e9; span *= 1.07)
    for (double low = 1.1e-7; low < 1e4; low *= 2.3) {
      CAPTURE(low);
      CAPTURE(span);
      const std::vector<Tick> ticks = log_ticks(low, low * span);
      const auto count =
          std::count_if(ticks.begin(), ticks.end(), [](const Tick& t) { return t.labelled; });
      CHECK(count >= 3);
      CHECK(count <= 12);
      CHECK(std::is_sorted(ticks.begin(), ticks.end(),
                           [](const Tick& a, const Tick& b) { return a.value < b.value; }));
      CHECK(ticks.front().value >= low * 0.999999);
      CHECK(ticks.back().value <= low * span * 1.000001);
    }
}

TEST_CASE("ticks are round") {
  using List = std::vector<std::string>;
  CHECK(labels(1.05, 2.2) == List{"1.2", "1.4", "1.6", "1.8", "2"});
  CHECK(labels(0.5, 2.2) == List{"0.5", "0.7", "1", "1.5", "2"});
  CHECK(labels(0.9, 9) == List{"1", "1.5", "2", "3", "5", "7"});
  CHECK(labels(0.03, 2) == List{"0.05", "0.1", "0.2", "0.5", "1", "2"});
  CHECK(labels(1, 1000) == List{"1", "3", "10", "30", "100", "300", "1000"});
  CHECK(labels(1e-6, 1) == List{"1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1", "1"});
  // Between the labelled powers of ten there are lines.
  CHECK(log_ticks(1e-6, 1).size() == 19);
  CHECK(tick_text(1.5e-5) == "1.5e-5");
  CHECK(tick_text(3e5) == "3e5");
  CHECK(tick_text(0.0015) == "0.0015");
}
