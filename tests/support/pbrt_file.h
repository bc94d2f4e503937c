// A pbrt file that is read, with what is said about it.
#pragma once

#include <doctest/doctest.h>

#include <optional>
#include <string>

#include "pbrt/pbrt.h"
#include "support/files.h"

namespace duet::test {

struct PbrtFile {
  std::optional<SceneDescription> scene;
  /// One line each.
  std::string messages;
};

inline PbrtFile read_pbrt_file(const std::string& file, const pbrt::Options& options = {}) {
  Diagnostics diagnostics;
  auto read = pbrt::read_pbrt(file, options, diagnostics);
  PbrtFile result;
  for (const Diagnostic& d : diagnostics.all()) result.messages += d.to_string() + "\n";
  if (read) result.scene = std::move(read->description);
  return result;
}

/// A file of that text, which finds no others.
inline PbrtFile read_pbrt_file_of(const std::string& text) {
  const TemporaryDirectory folder;
  return read_pbrt_file(folder.write("scene.pbrt", text));
}

/// The scene; the test fails with the messages if there is none.
inline SceneDescription scene_of(PbrtFile file) {
  REQUIRE_MESSAGE(file.scene.has_value(), file.messages);
  return std::move(*file.scene);
}

}  // namespace duet::test
