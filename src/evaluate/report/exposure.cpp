#include "evaluate/report/exposure.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace duet {

std::optional<Exposure> exposure_of(const std::string& text) {
  Exposure exposure;
  const char *from = text.data(), *const end = from + text.size();
  if (text.starts_with("auto")) {
    exposure.automatic = true;
    from += 4;
    if (from == end) return exposure;
    // "auto2" is a slip of the pen.
    if (*from != '+' && *from != '-') return std::nullopt;
    if (*from == '+' && ++from != end && *from == '-') return std::nullopt;
  }
  const auto [rest, error] = std::from_chars(from, end, exposure.stops);
  // Written so that NaN is refused.
  if (error != std::errc() || rest != end || !(std::abs(exposure.stops) <= kMaxExposure))
    return std::nullopt;
  return exposure;
}

std::string not_an_exposure(const std::string& text) {
  return fmt::format("\"{0}\" is not a number of stops from -{1} to {1}, nor auto or auto+1", text,
                     kMaxExposure);
}

}  // namespace duet
