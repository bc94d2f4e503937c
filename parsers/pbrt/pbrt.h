// Reads scene files of pbrt, versions 3 and 4.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "pbrt/parameter.h"
#include "scene/description.h"

namespace duet::pbrt {

struct Options {
  /// Which version the file has; without, it is found from what the file uses.
  std::optional<Version> version;
  /// Further directories to look for files, after the scene's own.
  std::vector<std::string> search_paths;
  /// Another method takes the place of the scene's integrator, which may then be unknown.
  bool replaces_integrator = false;
  /// Whether there is a file of that name. Empty: on the disk. Every file that is read is asked for
  /// here before.
  std::function<bool(const std::string& path)> exists;
};

struct PbrtScene {
  SceneDescription description;
  Version version = Version::v4;
};

/// Whether the name is that of a pbrt scene file: *.pbrt or *.pbrt.gz.
bool is_pbrt_file(std::string_view file);

/// Reads a scene with everything it includes and the meshes it names. Nothing is returned if there
/// were errors; all errors of all files are in `diagnostics`.
std::optional<PbrtScene> read_pbrt(const std::string& file, const Options& options,
                                   Diagnostics& diagnostics);

/// The version that a file's own directives tell, up to the first that only one version has;
/// nothing if there is none. The names of the files that it includes until then are added to
/// `includes`.
std::optional<Version> find_evidence(Lexer& in, std::vector<std::string>& includes);

/// The version that the main file tells, or the first that can of those that it includes, of which
/// only the heads are looked at; v4 if there is none. Throws ReadError if there is no main file.
Version find_version(const std::string& file, const Options& options);

/// The path of a file that the scene in `file` names: beside that or in the search paths; "" if
/// there is none.
std::string find_file(const std::string& file, const std::string& name, const Options& options);

}  // namespace duet::pbrt
