// Which of several estimates is the best, as far as their uncertainty tells.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "math/slope.h"

namespace duet {

/// A number with the interval that has it with a confidence of 95 %.
struct Estimate {
  double value = 0;
  Interval interval_95;
};

/// The indices of those that may be the largest (or the smallest): the one whose value is, first,
/// and all whose intervals overlap its interval. A single index says that there is a best one. What
/// is empty takes no part.
std::vector<size_t> contenders(const std::vector<std::optional<Estimate>>& estimates,
                               bool largest = true);

}  // namespace duet
