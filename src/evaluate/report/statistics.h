// The machine-readable account of a render.
#pragma once

#include <string>

#include "evaluate/report/header.h"

namespace duet {

struct PhaseSeconds {
  double parse = 0, build = 0, render = 0, write = 0;
};

struct SceneCounts {
  size_t emitters = 0, triangles = 0, instances = 0;
};
SceneCounts count_parts(const Scene& scene);

/// Whether the error that was asked for has been reached, as far as is known; false if it was not
/// asked for.
bool target_met(const RenderRecord& record, const RenderResult& result);

/// The JSON file of --stats: an object for a scene, or an array of them if there were several.
class StatisticsFile {
 public:
  explicit StatisticsFile(std::string path) : path_(std::move(path)) {}
  void add(const RenderRecord& record, const RenderResult& result, const PhaseSeconds& seconds,
           const SceneCounts& counts);
  /// A scene without an image, and why.
  void add_failure(const std::string& scene, const std::vector<std::string>& messages,
                   bool interrupted);
  /// Writes what was added. Throws std::runtime_error.
  void write(bool several) const;

 private:
  std::string path_;
  std::vector<std::string> entries_;
};

}  // namespace duet
