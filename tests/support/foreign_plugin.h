// What the tests of plugins that nobody else knows have in common.
#pragma once

#include <string>

#include "mitsuba/vocabulary.h"
#include "support/memory_scene.h"

namespace duet::test {

/// Reads scenes by the built-in vocabulary and one more plugin.
class ForeignPlugin {
 public:
  ForeignPlugin(PluginKind kind, const Plugin& plugin);

  const Vocabulary& vocabulary() const { return vocabulary_; }
  ReadResult read(const std::string& scene) const;
  /// What a scene describes for which the reader has no message.
  SceneDescription good(const std::string& scene) const;
  /// The XML of a scene. Checks that it is read as that scene, with its hash.
  std::string round_trip(const SceneDescription& scene) const;

 private:
  Vocabulary vocabulary_ = Vocabulary::built_in();
};

}  // namespace duet::test
