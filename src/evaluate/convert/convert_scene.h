// Writes a scene as a file of another format, together with the files that it then needs.
#pragma once

#include <string>
#include <vector>

#include "scene/description.h"

namespace duet {

struct ConvertedFile {
  std::string path, bytes;
};

struct ConvertedScene {
  /// The scene comes last: when it is there, everything is.
  std::vector<ConvertedFile> files;
  /// What the format cannot express, one sentence each.
  std::vector<std::string> losses;
};

/// Whether there is a format for the file's extension: .xml (Mitsuba 3) or .pbrt (version 4).
bool can_convert_to(const std::string& file);

/// What can be known to go wrong before the scene is read. Throws UsageError.
void check_conversion(const std::string& in, const std::string& out);

/// Nothing is written yet. Files that the scene names are named again, relative to `file`; what has
/// no file, or one that the format cannot use, gets one beside `file`: meshes (PLY), curves, grids
/// (.vol) and environments (EXR). Throws std::runtime_error for an environment whose image cannot
/// be read.
ConvertedScene convert_scene(const SceneDescription& scene, const std::string& file);

/// Of the files that would be written, one that exists already with another content: scenes and
/// meshes are often made by hand. Empty if there is none.
std::string taken_file(const ConvertedScene& converted);

}  // namespace duet
