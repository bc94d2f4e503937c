// How Ward's reflection model is normalised; see ward.h.
#pragma once

#include <cstdint>

namespace duet {

enum class WardVariant : uint8_t { ward, duer, balanced };

}  // namespace duet
