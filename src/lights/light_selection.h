// By what light samples choose their light.
#pragma once

#include <cstdint>
#include <string_view>

namespace duet {

enum class LightSelection : uint8_t {
  automatic,  ///< `bvh` where there are many lights, else `power`
  bvh,        ///< by what each is expected to send to the point that is lit (light_tree.h)
  power,      ///< by power, the same everywhere (selection_weights())
  uniform,    ///< all the same
};

/// By the selection.
inline constexpr std::string_view kLightSelectionNames[] = {"auto", "bvh", "power", "uniform"};

/// Up to so many lights, or triangles of one light, `automatic` does without a tree.
inline constexpr size_t kFewLights = 4;

}  // namespace duet
