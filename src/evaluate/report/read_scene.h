// Reads a scene file of any format.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/report/loaded_scene.h"

namespace duet {

/// Environment variable with further folders to look for files, after ReadingOptions::search_paths;
/// between colons.
inline constexpr const char* kPathVariable = "DUET_PATH";

/// What Mitsuba's and pbrt's readers are told.
struct ReadingOptions {
  std::vector<std::pair<std::string, std::string>> defines;  ///< as MitsubaOptions has them
  std::vector<std::string> search_paths;
  /// Methods that take the place of the scene's integrator, so that it may be unknown.
  std::vector<std::string> methods;
  int pbrt_version = 0;  ///< 3 or 4; 0: found from the file
  FileAccess files;
};

/// The scene; nothing after an error. Its warnings are in `diagnostics`, too.
std::optional<LoadedScene> read_scene(const std::string& file, const ReadingOptions& options,
                                      Diagnostics& diagnostics);

/// The names of the `$name` parameters that a scene has; nothing if it cannot be read. Meshes are
/// not looked at.
std::optional<std::vector<std::string>> parameters_of_scene(const std::string& file,
                                                            const ReadingOptions& options);

}  // namespace duet
