// The job array that renders a scene, from what is asked of all scenes of a call.
#pragma once

#include <string>
#include <vector>

#include "base/messages.h"
#include "evaluate/render/render_options.h"
#include "evaluate/slurm/scripts.h"

namespace duet::slurm {

/// What all images have in common.
struct ArrayRequest {
  uint32_t tasks = 1;                       ///< for each image
  std::string program;                      ///< `duet` as the nodes find it
  std::vector<std::string> outputs;         ///< templates of images; none: {scene}.exr here
  std::vector<std::string> render_options;  ///< arguments of `duet render` for the tasks
  bool has_threads = false;                 ///< whether they say how many
  std::vector<std::string> sbatch_options;
  RenderOptions render;  ///< what the arguments mean
};

/// The job of a scene, which is read, but not rendered. Throws UsageError for what makes no sense
/// and SceneFailure if the scene cannot be rendered.
ImageJob plan_job(const std::string& file, const ArrayRequest& request, Messages& messages);

/// Throws UsageError if two images have the same folder.
void check_folders_differ(const std::vector<ImageJob>& jobs);

}  // namespace duet::slurm
