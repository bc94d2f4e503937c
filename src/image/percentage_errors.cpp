#include "image/percentage_errors.h"

#include <cmath>
#include <stdexcept>

#include "image/colours.h"

namespace duet {

PercentageErrors percentage_errors(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw std::invalid_argument("the images have different sizes");
  const Colours a(image), b(reference);
  PercentageErrors e;
  double values = 0;
  for (size_t i = 0; i < a.pixels(); ++i) {
    bool finite = true;
    for (int c = 0; c < 3; ++c) finite &= std::isfinite(a(i, c)) && std::isfinite(b(i, c));
    if (!finite) continue;
    for (int c = 0; c < 3; ++c) {
      const double u = a(i, c), v = b(i, c), d = std::abs(u - v);
      e.mape += d / (std::abs(v) + kPercentageFloor);
      e.smape += 2 * d / (std::abs(u) + std::abs(v) + kPercentageFloor);
      values += 1;
    }
  }
  if (values > 0) e.mape /= values, e.smape /= values;
  return e;
}

}  // namespace duet
