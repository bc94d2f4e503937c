// How a spot light fades at its edge.
#pragma once

#include <string_view>

namespace duet {

/// Between full and no intensity: linear in the angle; t²(3 − 2t) (pbrt-v4) or t⁴ (pbrt-v3), where
/// t is linear in the angle's cosine.
enum class SpotFalloff { linear, smooth, quartic };
inline constexpr std::string_view kSpotFalloffs[] = {"linear", "smooth", "quartic"};

}  // namespace duet
