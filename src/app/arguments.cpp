#include "app/arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "app/commands.h"
#include "evaluate/report/render_limits.h"

namespace duet {

double parse_amount(const std::string& option, const std::string& text, const Units& units,
                    double least, double most) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  const std::string unit(rest, end);
  std::string names;
  for (const auto& [name, factor] : units) {
    // Written so that NaN is refused.
    if (error == std::errc() && unit == name && value * factor >= least && value * factor <= most)
      return value * factor;
    if (!name.empty()) names += (names.empty() ? ", perhaps with the unit " : " or ") + name;
  }
  throw UsageError(fmt::format("{}: \"{}\" is not a number from {:g} to {:g}{}", option, text,
                               least, most, names));
}

uint64_t parse_whole(const std::string& option, const std::string& text, uint64_t least,
                     uint64_t most) {
  uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || value < least || value > most)
    throw UsageError(
        fmt::format("{}: \"{}\" is not a whole number from {} to {}", option, text, least, most));
  return value;
}

std::vector<int> parse_integers(const std::string& option, const std::string& text, char separator,
                                size_t count, const char* form) {
  std::vector<int> values;
  const char *p = text.data(), *end = p + text.size();
  for (bool more = true; more;) {
    int value = 0;
    const auto [rest, error] = std::from_chars(p, end, value);
    if (error != std::errc()) break;
    values.push_back(value);
    p = rest;
    more = p != end && *p == separator;
    p += more;
  }
  if (p != end || values.size() != count)
    throw UsageError(fmt::format("{}: \"{}\" is not of the form {}", option, text, form));
  return values;
}

Point2i parse_size(const std::string& option, const std::string& text, int least) {
  const auto v = parse_integers(option, text, 'x', 2, "WxH");
  if (v[0] < least || v[1] < least || v[0] > kMaxImageSide || v[1] > kMaxImageSide)
    throw UsageError(fmt::format("{0}: {1} is not a size from {2}x{2} to {3}x{3}", option, text,
                                 least, kMaxImageSide));
  return {v[0], v[1]};
}

double parse_seconds(const std::string& option, const std::string& text) {
  return parse_amount(option, text, {{"", 1}, {"s", 1}, {"m", 60}, {"h", 3600}}, 1e-3, kMaxSeconds);
}

}  // namespace duet
