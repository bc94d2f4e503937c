#include "math/log_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

/// What a power of ten is multiplied by, from the coarsest series to the finest.
const std::vector<std::vector<double>>& series() {
  static const std::vector<std::vector<double>> list{
      {1},
      {1, 3},
      {1, 2, 5},
      {1, 1.5, 2, 3, 5, 7},
      {1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9}};
  return list;
}

constexpr size_t kEnoughLabels = 5;

}  // namespace

std::vector<Tick> log_ticks(double low, double high) {
  const int first = int(std::floor(std::log10(low))), last = int(std::ceil(std::log10(high)));
  std::vector<Tick> ticks;
  const auto add = [&](const std::vector<double>& digits, bool labelled) {
    for (int power = first; power <= last; ++power)
      for (const double digit : digits) {
        const double v = digit * std::pow(10, power);
        if (v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9)) ticks.push_back({v, labelled});
      }
  };
  const std::vector<double>* chosen = nullptr;
  for (const std::vector<double>& digits : series()) {
    ticks.clear();
    add(digits, true);
    chosen = &digits;
    if (ticks.size() >= kEnoughLabels) break;
  }
  if (chosen->size() == 1) {
    add({2, 5}, false);
    std::sort(ticks.begin(), ticks.end(),
              [](const Tick& a, const Tick& b) { return a.value < b.value; });
  }
  return ticks;
}

std::string tick_text(double value) {
  if (value >= 1e-3 && value < 1e5) return fmt::format("{:g}", value);
  const int power = int(std::floor(std::log10(value) + 1e-9));
  return fmt::format("{:g}e{}", std::round(value / std::pow(10, power) * 100) / 100, power);
}

}  // namespace duet
