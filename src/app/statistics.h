// The machine-readable account of a render.
#pragma once

#include <string>

#include "app/header.h"

namespace duet {

struct PhaseSeconds {
  double parse = 0, build = 0, render = 0, write = 0;
};

struct SceneCounts {
  size_t emitters = 0, triangles = 0, instances = 0;
};

/// The JSON file of --stats: an object for a scene, or an array of them if there were several.
class StatisticsFile {
 public:
  explicit StatisticsFile(std::string path) : path_(std::move(path)) {}
  void add(const RenderRecord& record, const RenderResult& result, const PhaseSeconds& seconds,
           const SceneCounts& counts);
  /// Writes what was added; nothing if a single scene failed. Throws std::runtime_error.
  void write(bool several) const;

 private:
  std::string path_;
  std::vector<std::string> entries_;
};

}  // namespace duet
