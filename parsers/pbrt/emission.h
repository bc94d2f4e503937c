// Colours of what emits.
#pragma once

#include "pbrt/values.h"

namespace duet::pbrt {

/// pbrt scales lights so that RGB numbers are luminances over its integral of ȳ; where it does not,
/// light is so many times brighter.
inline constexpr float kUnscaled = 106.856895f;

/// What a light or medium emits before its scale. v4 brings spectra to luminance 1, but leaves the
/// size of RGB numbers. Without the parameter: white.
Spectrum emitted_color(Values& v, std::string_view name);

}  // namespace duet::pbrt
