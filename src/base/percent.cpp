#include "base/percent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet {

std::string percent(double fraction) {
  const double value = 100 * fraction;
  if (!std::isfinite(value)) return fmt::format("{} %", value);
  constexpr int kMostDecimals = 12;
  int decimals = 0;
  if (value != 0)
    decimals = std::clamp(2 - int(std::floor(std::log10(std::abs(value)))), 0, kMostDecimals);
  std::string digits = fmt::format("{:.{}f}", value, decimals);
  if (digits.find('.') != std::string::npos) {
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return digits + " %";
}

}  // namespace duet
