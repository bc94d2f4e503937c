// How images are shown, in words.
#pragma once

#include <string>
#include <vector>

#include "image/tone_curve.h"

namespace duet {

/// The options of `duet` that mean the settings.
std::vector<std::string> display_arguments(const DisplaySettings& settings);
/// The settings in the fingerprint of an image.
std::string display_text(const DisplaySettings& settings);

}  // namespace duet
