// Scenes, from files, from texts and from descriptions.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace duet {

class SceneObject;

/// How a scene is read.
struct SceneFileOptions {
  /// Values of the scene's `$name` parameters.
  std::vector<std::pair<std::string, std::string>> defines;
  /// Further folders to look for files, before those of the environment variable DUET_PATH.
  std::vector<std::string> search_paths;
};

/// A scene as its file describes it: Mitsuba's XML of versions 0.4 to 3.x, or pbrt's of 3 and 4. It
/// never changes; copies share it, and threads may render one at once.
class [[gnu::visibility("default")]] SceneFile {
 public:
  /// Throws SceneError.
  static SceneFile load(const std::string& path, const SceneFileOptions& options = {});
  /// The text of a Mitsuba XML file. Its relative files are looked for from the current folder.
  /// Throws SceneError.
  static SceneFile from_text(const std::string& text, const SceneFileOptions& options = {});
  /// A scene that is put together (scene_description.h). It has no `$name` parameters. Relative
  /// files as for texts. Throws SceneError, whose messages name objects instead of lines.
  static SceneFile from_description(const SceneObject& scene, const SceneFileOptions& options = {});

  /// The path, "<string>" or "<description>".
  const std::string& name() const;
  /// What was noticed while it was read, as "file:line:column: warning: text"
  /// or "scene.object.parameter: warning: text".
  std::vector<std::string> warnings() const;
  /// What `duet info --json` prints.
  std::string info_json() const;
  /// What `duet info` prints.
  std::string summary() const;

  /// The library's own.
  struct Contents;
  const Contents& contents() const {
    return *contents_;
  }

 private:
  explicit SceneFile(std::shared_ptr<const Contents> contents) : contents_(std::move(contents)) {}
  std::shared_ptr<const Contents> contents_;
};

}  // namespace duet
