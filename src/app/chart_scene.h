// One scene of `duet chart`: all its methods, taking turns.
#pragma once

#include "app/chart_data.h"
#include "app/chart_options.h"

namespace duet {

/// Renders scene number `index` with all methods until the time is used up or the program is
/// interrupted, and says on the log how far it is. `directory` is where a reference goes that has
/// to be made. Throws SceneFailure, UsageError or other exceptions; nothing is empty, but after an
/// interrupt lines may have few points or none.
ChartScene measure_scene(const ChartOptions& options, size_t index, const std::string& name,
                         const std::string& directory);

}  // namespace duet
