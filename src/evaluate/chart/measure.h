// One scene of a chart: all its methods, taking turns.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>

#include "base/diagnostics.h"
#include "evaluate/chart/data.h"
#include "evaluate/chart/reference.h"
#include "evaluate/chart/renderers.h"
#include "scene/description.h"

namespace duet {

/// A method to compare: its name on the chart, and what it is.
struct ChartMethod {
  std::string name;
  IntegratorOverride integrator;
};

/// Another renderer to compare: its name on the chart, and the command as it was given.
struct ExternalMethod {
  std::string name, text;
  ExternalCommand command;
};

/// What a chart of one scene is to show.
struct ChartPlan {
  std::string name, file;  ///< of the scene
  SceneDescription description;
  size_t sensor = 0;
  std::optional<Point2i> size;  ///< instead of the reference's or the scene's
  std::vector<ChartMethod> methods;
  std::vector<ExternalMethod> external;
  /// What is right; without it one is made, by `reference_method` or by a choice.
  std::optional<ChartReference> reference;
  std::optional<ChartMethod> reference_method;
  std::string directory;     ///< where a reference that is made is saved; "": nowhere. External
                             ///< renderers need one, too.
  std::string command_line;  ///< for the header of a reference that is made
  double seconds = 60;       ///< for all methods and the reference together
  uint64_t seed = 0;
  int threads = 1;
  const std::atomic<bool>* cancel = nullptr;
};

/// Whom to tell what happens.
struct ChartMessages {
  std::function<void(const std::string&)> info, warning;
  /// What is wrong with the scene for a method, or with its parts; may throw.
  std::function<void(const Diagnostics&)> report;
};

/// The methods that are asked for cannot be compared on this scene.
class ChartMethodError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Renders the scene with all methods until the time is used up or the plan is cancelled. Throws
/// ChartMethodError, std::runtime_error, and what `messages` and the commands of external renderers
/// throw; nothing is empty, but after a cancellation lines may have few points or none.
ChartScene measure_chart(ChartPlan plan, const ChartMessages& messages);

}  // namespace duet
