// One scene, from its file to its images.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "base/messages.h"
#include "evaluate/live/live_page.h"
#include "evaluate/render/batch.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/render_options.h"
#include "evaluate/report/statistics.h"
#include "integrators/pass.h"

namespace duet {

enum class RenderOutcome {
  rendered,       ///< and the image is written, also after an interrupt
  not_rendered,   ///< the images exist already, or an interrupt came too early
  target_missed,  ///< the image is written, but its error is above --target-error, or not known
  kept_target_missed,  ///< the same of images that exist already
};

using ShowProgress = std::function<void(const RenderProgress&)>;

/// The call that a scene is part of.
struct RenderCall {
  const Batch& batch;
  StatisticsFile& statistics;
  const std::string& command_line;  ///< for the header of images
  const FileUses& uses;             ///< of the files that the call names
  Messages& messages;
  /// What shows the progress of a scene of that name, for as long as it lives.
  std::function<ShowProgress(const std::string& scene)> progress;
  const std::atomic<bool>& interrupt;  ///< whether rendering is to stop
  /// Whether the image so far has been asked for since the last call.
  std::function<bool()> wants_snapshot;
  LivePage* page;  ///< that shows the image as it grows, or null
};

/// Reads, builds and renders a scene and writes its images. Throws SceneFailure, UsageError (the
/// command line asks for what this scene does not have) or other exceptions. After an interrupt the
/// image is written with the samples it has, under the name for partial images, if every pixel has
/// one.
RenderOutcome render_scene(const std::string& file, const RenderOptions& options,
                           const RenderCall& call);

}  // namespace duet
