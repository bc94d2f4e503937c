// Colours of what emits.
#pragma once

#include "pbrt/values.h"

namespace duet::pbrt {

/// What a light or medium emits before its scale. v4 brings spectra to luminance 1, but leaves the
/// size of RGB numbers. Without the parameter: white.
Spectrum emitted_color(Values& v, std::string_view name);

}  // namespace duet::pbrt
