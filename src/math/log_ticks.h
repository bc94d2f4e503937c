// Round numbers for logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace duet {

struct Tick {
  double value;
  bool labelled;
};

/// Ticks from `low` to `high` (0 < low < high), in order, at powers of ten and round multiples of
/// them: the coarsest of several series that labels five, or else the finest, so that an axis over
/// a factor of 2 or more has three labels at least.
std::vector<Tick> log_ticks(double low, double high);

/// A tick's value as text, such as 0.015, 300 or 1.5e-5.
std::string tick_text(double value);

}  // namespace duet
