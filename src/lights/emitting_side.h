// On which side of a surface its light leaves.
#pragma once

#include <cstdint>
#include <string_view>

namespace duet {

/// `geometric` and `shading` differ where a shading normal leans over: pbrt asks the geometric
/// normal, Mitsuba the shading one. A geometric normal always lies on the side of the shading
/// normal.
enum class EmittingSide : uint8_t { shading, geometric, both };
inline constexpr std::string_view kEmittingSides[] = {"shading normal", "geometric normal", "both"};

}  // namespace duet
