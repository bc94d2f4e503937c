// A number that tells scenes apart by what they describe.
#pragma once

#include <cstdint>
#include <string>

namespace duet {

struct SceneDescription;

/// 128 bits, against mistakes, not against attacks.
struct ContentHash {
  uint64_t high = 0, low = 0;
  bool operator==(const ContentHash&) const = default;
  /// 32 hexadecimal digits.
  std::string text() const;
};

/// Equal for descriptions of the same scene, whatever the files were that they came from: places,
/// names and the order of textures, materials, media and groups do not count, nor what no shape,
/// light or sensor refers to. Meshes, grids and measurements count by their content, and so do
/// images, whose files are read; one that cannot be read counts by its name. The order of shapes,
/// lights and sensors counts: it decides which random numbers they get.
ContentHash content_hash(const SceneDescription& scene);

}  // namespace duet
