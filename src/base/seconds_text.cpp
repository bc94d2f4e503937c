#include "base/seconds_text.h"

#include <fmt/format.h>

namespace duet {

std::string seconds_text(double s) {
  if (s < 60) return fmt::format("{:.1f} s", s);
  const long t = long(s + 0.5);
  if (t < 3600) return fmt::format("{} min {} s", t / 60, t % 60);
  return fmt::format("{} h {} min", t / 3600, t % 3600 / 60);
}

}  // namespace duet
