#include "support/pbrt_file.h"

namespace duet::test {

PbrtFile read_pbrt_file(const std::string& file, const pbrt::Options& options) {
  Diagnostics diagnostics;
  auto read = pbrt::read_pbrt(file, options, diagnostics);
  PbrtFile result;
  for (const Diagnostic& d : diagnostics.all()) result.messages += d.to_string() + "\n";
  if (read) result.scene = std::move(read->description);
  return result;
}

PbrtFile read_pbrt_file_of(const std::string& text) {
  const TemporaryDirectory folder;
  return read_pbrt_file(folder.write("scene.pbrt", text));
}

SceneDescription scene_of(PbrtFile file) {
  REQUIRE_MESSAGE(file.scene.has_value(), file.messages);
  return std::move(*file.scene);
}

}  // namespace duet::test
