// Reads the scenes that are named on the command line.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/description.h"

namespace CLI {
class App;
}

namespace duet {

/// What the command line says about reading scenes.
struct ReadOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> defines;  ///< NAME=VALUE
  std::vector<std::string> search_paths;
  /// Methods that take the place of the scene's integrator, so that it may be unknown.
  std::vector<std::string> methods;
  bool strict = false;  ///< warnings are errors
};

/// Adds the scenes and the options -D, -a and --strict to a command.
void add_read_options(CLI::App& command, ReadOptions& options);

/// Throws UsageError for defines that are not NAME=VALUE or that no scene has a use for. Scenes
/// that cannot be read may have a use for any.
void check_defines(const ReadOptions& options);

struct LoadedScene {
  SceneDescription description;
  /// The scene's `$name` parameters and the values they got.
  std::vector<std::pair<std::string, std::string>> parameters;
};

/// Prints the messages; returns whether there is an error among them (or, if strict, a warning).
bool report(const Diagnostics& diagnostics, bool strict);

/// Reads one scene file and prints what is wrong with it. Empty if it cannot be used.
std::optional<LoadedScene> load_scene(const std::string& file, const ReadOptions& options);

}  // namespace duet
