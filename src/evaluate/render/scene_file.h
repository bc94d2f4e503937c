// Reads the scenes that a user names.
#pragma once

#include <string>
#include <vector>

#include "base/failures.h"
#include "base/messages.h"
#include "evaluate/report/loaded_scene.h"

namespace duet {

/// What is asked of reading scenes.
struct ReadOptions {
  std::vector<std::string> scenes;   ///< files, or kStandardInput
  std::string standard_input;        ///< what was read from there
  std::vector<std::string> defines;  ///< NAME=VALUE
  std::vector<std::string> search_paths;
  /// Methods that take the place of the scene's integrator, so that it may be unknown.
  std::vector<std::string> methods;
  bool strict = false;   ///< warnings are errors
  int pbrt_version = 0;  ///< 3 or 4; 0: found from the file
};

/// Throws UsageError for defines that are not NAME=VALUE or that no scene has a use for. Scenes
/// that cannot be read may have a use for any.
void check_defines(const ReadOptions& options);

/// Passes the messages on. Throws SceneFailure if there is an error among them or, if strict, any.
void report(const Diagnostics& diagnostics, bool strict, Messages& messages);

/// Reads one scene file and says what is wrong with it. Throws SceneFailure if it cannot be used.
LoadedScene load_scene(const std::string& file, const ReadOptions& options, Messages& messages);

}  // namespace duet
