// Enlarges a grid of numbers with a reconstruction filter.
#pragma once

#include <vector>

#include "image/filter.h"

namespace duet {

/// `values` has height × width numbers at the centres of pixels; the result has more of them, or as
/// many, over the same area. The weights of each new number sum to one; beyond its edges the grid
/// goes on with its outermost numbers. Filters with negative lobes may overshoot.
std::vector<float> enlarge(std::vector<float> values, int width, int height, int new_width,
                           int new_height, const FilterDescription& filter);

}  // namespace duet
