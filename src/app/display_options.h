// --exposure and --tonemap: how .png and .jpg show radiance.
#pragma once

#include <string>
#include <vector>

#include "image/tone_curve.h"

namespace CLI {
class App;
}

namespace duet {

void add_display_options(CLI::App& c, std::string& exposure, std::string& tone_map);
/// Throws UsageError.
DisplaySettings parse_display(const std::string& exposure, const std::string& tone_map);
/// The options that mean the settings.
std::vector<std::string> display_arguments(const DisplaySettings& settings);
/// The settings in the fingerprint of an image.
std::string display_text(const DisplaySettings& settings);

}  // namespace duet
