// What is asked of image files, in words.
#pragma once

#include <string>
#include <vector>

#include "evaluate/report/file_settings.h"

namespace duet {

/// The options of `duet` that mean the settings.
std::vector<std::string> file_arguments(const FileSettings& settings);
/// Those of the settings that decide the bytes of this file, in the fingerprint of an image; "" of
/// an EXR file in the preset form.
std::string file_settings_text(const std::string& path, const FileSettings& settings);

}  // namespace duet
