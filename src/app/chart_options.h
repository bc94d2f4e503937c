// The options of `duet chart`.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/chart/measure.h"
#include "evaluate/render/scene_file.h"

namespace CLI {
class App;
}

namespace duet {

/// "path,vcm:radius=0.01,alpha=0.7": methods with commas between them, each with its parameters
/// after a colon; a part with "=" and without ":" belongs to the method before it. Throws
/// UsageError.
std::vector<ChartMethod> parse_methods(const std::string& text);

struct ChartOptions {
  ReadOptions read;
  std::string directory = "chart";
  std::vector<ChartMethod> methods;
  std::vector<std::pair<std::string, std::string>> external;  ///< name and command
  std::vector<std::string> references, variances;
  double reference_spp = 0;          ///< 0 takes that of the reference's header
  std::string reference_integrator;  ///< of a reference that is made, or "" for a choice
  double seconds = 60;
  std::optional<Point2i> size;
  size_t sensor = 0;
  /// Not that of most references: nobody's samples are to be compared with themselves.
  uint64_t seed = 1000;
  int threads = 1;
  bool quiet = false;
};

/// Adds the options to a command; `finish` is to be called once they are parsed and throws
/// UsageError for values that make no sense.
class ChartOptionParser {
 public:
  explicit ChartOptionParser(CLI::App& command);
  /// `threads` are those of a call that says nothing about them.
  ChartOptions finish(int threads);

 private:
  ChartOptions options_;
  std::vector<std::string> methods_, parameters_, external_;
  std::string time_, reference_spp_, size_, sensor_, seed_, threads_;
};

/// The name of a scene among those of one call: that of its folder if the file is just called
/// "scene", that of the file otherwise. Throws UsageError if two are equal.
std::vector<std::string> chart_names(const std::vector<std::string>& scene_files);

}  // namespace duet
