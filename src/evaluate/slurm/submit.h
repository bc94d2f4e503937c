// Submits the jobs of an image to Slurm.
#pragma once

#include "base/messages.h"
#include "evaluate/slurm/scripts.h"

namespace duet::slurm {

/// Writes the scripts into the job's folder, and submits the array that renders and the job that
/// merges. Throws std::runtime_error if that fails; if nothing was submitted then, the new files
/// and folders go away again.
void submit(const ImageJob& job, Messages& messages);

}  // namespace duet::slurm
