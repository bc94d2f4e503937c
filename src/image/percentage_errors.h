// Absolute errors relative to the values themselves: MAPE and SMAPE, as renderers and denoisers
// define them.
#pragma once

#include "image/image.h"

namespace duet {

/// Added to the denominators, so that black pixels do not decide everything.
inline constexpr double kPercentageFloor = 0.01;

/// Means over the channels R, G and B of all pixels that are finite in both images; 1 is 100 %.
struct PercentageErrors {
  double mape = 0;   ///< mean of |a − b| / (|b| + 0.01)
  double smape = 0;  ///< mean of 2 |a − b| / (|a| + |b| + 0.01), from 0 to 2
};

/// Both images have linear values. Throws std::invalid_argument if the sizes differ or colours are
/// missing.
PercentageErrors percentage_errors(const Image& image, const Image& reference);

}  // namespace duet
