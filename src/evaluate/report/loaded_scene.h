// A scene as it was read, with what is known of its files.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "evaluate/report/input_files.h"
#include "scene/description.h"

namespace duet {

struct LoadedScene {
  SceneDescription description;
  std::string version;  ///< of the file's format
  /// The scene's `$name` parameters and the values they got.
  std::vector<std::pair<std::string, std::string>> parameters;
  InputFiles files;
  std::vector<Diagnostic> warnings;
};

}  // namespace duet
