// One scene of `duet render`, from its file to its images.
#pragma once

#include <stdexcept>
#include <string>

#include "app/render_options.h"
#include "app/statistics.h"

namespace duet {

/// The scene cannot be rendered as asked; an empty message means that all has been printed.
class SceneFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class RenderOutcome {
  done,           ///< also if there was nothing to do, or an interrupt
  target_missed,  ///< the image is written, but its error is above --target-error, or not known
};

/// Reads, builds and renders a scene and writes its images. Throws SceneFailure, UsageError (the
/// command line asks for what this scene does not have) or other exceptions. After an interrupt the
/// image is written with the samples it has, under the name for partial images, if every pixel has
/// one.
RenderOutcome render_scene(const std::string& file, const RenderOptions& options,
                           StatisticsFile& statistics);

}  // namespace duet
