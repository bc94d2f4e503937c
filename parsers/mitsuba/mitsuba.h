// Reads Mitsuba scene files, versions 0.4 to 3.x.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "scene/description.h"

namespace duet {

struct MitsubaOptions {
  /// Values of `$name` parameters; they win over the scene's own defaults.
  std::vector<std::pair<std::string, std::string>> defines;
  /// Further directories to look for files, after the scene's own.
  std::vector<std::string> search_paths;
};

struct MitsubaScene {
  SceneDescription description;
  /// The `$name` parameters that the scene has, with the values they got, in order of appearance.
  std::vector<std::pair<std::string, std::string>> parameters;
};

/// Reads a scene with everything it includes and the meshes it names. Nothing is returned if there
/// were errors; all errors of all files are in `diagnostics`.
std::optional<MitsubaScene> read_mitsuba(const std::string& file, const MitsubaOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace duet
