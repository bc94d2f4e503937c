// --exposure and --tonemap: how .png and .jpg show radiance.
#pragma once

#include <string>

#include "image/tone_curve.h"

namespace CLI {
class App;
}

namespace duet {

void add_display_options(CLI::App& c, std::string& exposure, std::string& tone_map);
/// Throws UsageError.
DisplaySettings parse_display(const std::string& exposure, const std::string& tone_map);

}  // namespace duet
