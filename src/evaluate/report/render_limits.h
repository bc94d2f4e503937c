// How large what users ask for may be: guards against slips of the pen.
#pragma once

namespace duet {

inline constexpr int kMaxImageSide = 65536;
inline constexpr double kMaxSeconds = 366 * 24 * 3600.0;
inline constexpr int kMaxSpp = 1 << 30;

}  // namespace duet
