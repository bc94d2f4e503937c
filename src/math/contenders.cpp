#include "math/contenders.h"

namespace duet {

std::vector<size_t> contenders(const std::vector<std::optional<Estimate>>& estimates,
                               bool largest) {
  std::optional<size_t> first;
  for (size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates[i]) continue;
    if (!first || (largest ? estimates[i]->value > estimates[*first]->value
                           : estimates[i]->value < estimates[*first]->value))
      first = i;
  }
  if (!first) return {};
  std::vector<size_t> list{*first};
  const Interval& best = estimates[*first]->interval_95;
  for (size_t i = 0; i < estimates.size(); ++i) {
    if (i == *first || !estimates[i]) continue;
    const Interval& other = estimates[i]->interval_95;
    if (other.high >= best.low && other.low <= best.high) list.push_back(i);
  }
  return list;
}

}  // namespace duet
