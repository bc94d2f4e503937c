// Linear maps of colours.
#pragma once

#include <array>

#include "math/spectrum.h"

namespace duet {

/// By rows: what the columns of colours are multiplied by.
using ColorMatrix = std::array<std::array<double, 3>, 3>;

inline Spectrum operator*(const ColorMatrix& m, const Spectrum& c) {
  const auto row = [&](size_t i) {
    return float(m[i][0] * double(c.r) + m[i][1] * double(c.g) + m[i][2] * double(c.b));
  };
  return {row(0), row(1), row(2)};
}

}  // namespace duet
