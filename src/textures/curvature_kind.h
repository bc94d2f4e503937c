// Which curvature a texture shows.
#pragma once

#include <cstdint>

namespace duet {

enum class CurvatureKind : uint8_t {
  gaussian,
  mean,
};

}  // namespace duet
