// One scene of `duet render`, from its file to its images.
#pragma once

#include <string>

#include "app/batch.h"
#include "app/render_options.h"
#include "app/statistics.h"

namespace duet {

/// Reads, builds and renders a scene and writes its images. Throws SceneFailure, UsageError (the
/// command line asks for what this scene does not have) or other exceptions. After an interrupt the
/// image is written with the samples it has, if rendering had begun. Returns whether anything was
/// rendered: the images may exist already.
bool render_scene(const std::string& file, const RenderOptions& options, const Batch& batch,
                  StatisticsFile& statistics);

}  // namespace duet
