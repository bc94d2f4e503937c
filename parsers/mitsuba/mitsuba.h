// Reads Mitsuba scene files, versions 0.4 to 3.x.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "files/file_access.h"
#include "scene/description.h"

namespace duet {

class Vocabulary;

/// How deep elements may be nested, those of values counted, too.
inline constexpr int kDeepestNesting = 64;

struct MitsubaOptions {
  /// The plugins that are known; null for those that come with the program. Must outlive reading.
  const Vocabulary* vocabulary = nullptr;
  /// Values of `$name` parameters; they win over the scene's own defaults.
  std::vector<std::pair<std::string, std::string>> defines;
  /// Further directories to look for files, after the scene's own.
  std::vector<std::string> search_paths;
  /// Methods that take the place of the scene's integrator afterwards, one after the other. One of
  /// another type is replaced, then: it may be unknown, its parameters are not checked, and of
  /// those only max_depth, rr_depth, hide_emitters and strict_normals are read. Integrators that
  /// make layers are no methods, and stay.
  std::vector<std::string> replacing_methods;
  FileAccess files;
};

struct MitsubaScene {
  SceneDescription description;
  std::string version;  ///< of the format, as the main file gives it: "3.0.0"
  /// The `$name` parameters that the scene has, with the values they got, in order of appearance.
  std::vector<std::pair<std::string, std::string>> parameters;
};

/// Reads a scene with everything it includes and the meshes it names. Nothing is returned if there
/// were errors; all errors of all files are in `diagnostics`.
std::optional<MitsubaScene> read_mitsuba(const std::string& file, const MitsubaOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace duet
