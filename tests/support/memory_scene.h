// Scenes for tests of the parsers, from texts in memory.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mitsuba/mitsuba.h"

namespace duet::test {

/// Files by their paths. Folders exist if a file lies in them; meshes are rectangles, but OBJ files
/// with faces whose parts are asked for and volumes are what their bytes say.
struct MemoryFiles {
  std::map<std::string, std::string> texts;
  FileAccess access() const;
};

/// What came of reading a scene.
struct ReadResult {
  std::optional<MitsubaScene> scene;
  Diagnostics diagnostics;

  const SceneDescription& description() const { return scene->description; }
  /// All messages, one a line.
  std::string messages() const;
  bool has(const std::string& text) const { return messages().find(text) != std::string::npos; }
};

/// Reads `text` as the file scene.xml in the folder /scene, with further files beside it.
ReadResult read_text(const std::string& text, MemoryFiles files = {},
                     std::vector<std::pair<std::string, std::string>> defines = {});

/// The same with these options.
ReadResult read_with(MitsubaOptions options, const std::string& text, MemoryFiles files = {});

/// The content of a scene, with its root, and a sensor and an integrator so that it is complete.
std::string scene_text(const std::string& version, const std::string& content);
ReadResult read_scene(const std::string& version, const std::string& content,
                      MemoryFiles files = {});

/// The only or last material of a scene with a sphere of it.
template <class M>
M read_bsdf(const std::string& version, const std::string& bsdf) {
  const ReadResult r = read_scene(version, "<shape type='sphere'>" + bsdf + "</shape>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().materials.back().model.get<M>();
}

}  // namespace duet::test
