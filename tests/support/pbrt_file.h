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

PbrtFile read_pbrt_file(const std::string& file, const pbrt::Options& options = {});

/// A file of that text, which finds no others.
PbrtFile read_pbrt_file_of(const std::string& text);

/// The scene; the test fails with the messages if there is none.
SceneDescription scene_of(PbrtFile file);

}  // namespace duet::test
