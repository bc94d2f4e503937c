// Reads the scenes that are named on the command line.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "evaluate/report/loaded_scene.h"

namespace CLI {
class App;
}

namespace duet {

class Log;
struct Program;

/// What the command line says about reading scenes.
struct ReadOptions {
  std::vector<std::string> scenes;   ///< files, or kStandardInput
  std::vector<std::string> defines;  ///< NAME=VALUE
  std::vector<std::string> search_paths;
  /// Methods that take the place of the scene's integrator, so that it may be unknown.
  std::vector<std::string> methods;
  bool strict = false;   ///< warnings are errors
  int pbrt_version = 0;  ///< 3 or 4; 0: found from the file
};

/// Adds the scenes and the options -D, -a and --strict to a command.
void add_read_options(CLI::App& command, ReadOptions& options);

/// Throws UsageError for defines that are not NAME=VALUE or that no scene has a use for. Scenes
/// that cannot be read may have a use for any.
void check_defines(const ReadOptions& options, const Program& program);

/// The scene cannot be used as asked.
class SceneFailure : public std::runtime_error {
 public:
  explicit SceneFailure(const std::string& reason, bool is_printed = false)
      : std::runtime_error(reason), is_printed_(is_printed) {}
  /// Whether the user has been told: what() is then the first of several messages.
  bool is_printed() const { return is_printed_; }

 private:
  bool is_printed_;
};

/// Prints the messages. Throws SceneFailure if there is an error among them or, if strict, any.
void report(const Diagnostics& diagnostics, bool strict, Log& log);

/// Reads one scene file and prints what is wrong with it. Throws SceneFailure if it cannot be used.
LoadedScene load_scene(const std::string& file, const ReadOptions& options, Program& program);

}  // namespace duet
