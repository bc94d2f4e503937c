#include "base/percent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

/// With that many significant digits and no exponent, without zeros at the end, and never rounded
/// to more than a unit.
std::string decimal(double value, int significant) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  constexpr int kMostDecimals = 12;
  int decimals = 0;
  if (value != 0)
    decimals = std::clamp(significant - 1 - int(std::floor(std::log10(std::abs(value)))), 0,
                          kMostDecimals);
  std::string digits = fmt::format("{:.{}f}", value, decimals);
  if (digits.find('.') != std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return digits;
}

}  // namespace

std::string percent(double fraction) {
  return decimal(100 * fraction, 3) + " %";
}

std::string ratio(double value) {
  return decimal(value, 2);
}

}  // namespace duet
