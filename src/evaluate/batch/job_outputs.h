// Where the images of jobs go.
#pragma once

#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet::batch {

/// Makes paths of the templates of the jobs' outputs, those of jobs that have none of `templates`:
/// {scene}, {folder} and the names of the job's options are filled in, and of scenes that were
/// found below `folder` also {subfolder}, the way from there. Outputs that make no sense are errors
/// at the job's place.
void name_outputs(std::vector<Job>& jobs, const std::vector<std::string>& templates,
                  const std::string& folder, Diagnostics& diagnostics);

/// An error, with both places, for each image or raw film that a job before writes, too, or that
/// another job reads.
void check_outputs_differ(const std::vector<Job>& jobs, Diagnostics& diagnostics);

}  // namespace duet::batch
