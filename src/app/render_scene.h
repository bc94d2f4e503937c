// One scene of `duet render`, from its file to its images.
#pragma once

#include <string>

#include "app/batch.h"
#include "app/render_options.h"
#include "evaluate/report/statistics.h"

namespace duet {

enum class RenderOutcome {
  rendered,       ///< and the image is written, also after an interrupt
  not_rendered,   ///< the images exist already, or an interrupt came too early
  target_missed,  ///< the image is written, but its error is above --target-error, or not known
};

/// The call that a scene is part of.
struct RenderCall {
  const Batch& batch;
  StatisticsFile& statistics;
  Program& program;
};

/// Reads, builds and renders a scene and writes its images. Throws SceneFailure, UsageError (the
/// command line asks for what this scene does not have) or other exceptions. After an interrupt the
/// image is written with the samples it has, under the name for partial images, if every pixel has
/// one.
RenderOutcome render_scene(const std::string& file, const RenderOptions& options,
                           const RenderCall& call);

}  // namespace duet
