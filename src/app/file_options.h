// The options that say in which form image files are written, besides what the film says.
#pragma once

#include <string>

#include "evaluate/report/file_settings.h"

namespace CLI {
class App;
}

namespace duet {

/// What the options say, in the user's words.
struct FileOptions {
  std::string exposure = "0", tone_map, png_depth = "8", aov_names = "duet";
  bool exr_parts = false;
};

void add_file_options(CLI::App& c, FileOptions& options);
/// Throws UsageError.
FileSettings parse_file_settings(const FileOptions& options);

}  // namespace duet
