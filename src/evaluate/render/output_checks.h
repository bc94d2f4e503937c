// What can be known of outputs before any scene is read.
#pragma once

#include "evaluate/render/render_options.h"

namespace duet {

/// Throws UsageError if two scenes would be written to one file, if a name cannot be known, or if
/// standard output cannot hold what it is to hold.
void check_outputs(const RenderOptions& options);

}  // namespace duet
