// What the jobs of `duet batch` have to do with the options of `duet render`: its own parser is
// asked which there are and what their values may be.
#pragma once

#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet {

struct Program;

/// The options that jobs can have.
std::vector<batch::RenderOption> job_option_names(Program& program);

/// The options of `duet render` in these arguments, which are for all jobs. Throws UsageError.
std::vector<batch::JobOption> options_for_all(const std::vector<std::string>& arguments,
                                              Program& program);

/// Makes paths of the templates of the jobs' outputs, or of `templates` for those that have none:
/// {scene}, {folder} and the names of the job's options are filled in, and of scenes that were
/// found below `folder` ("" for a list) also {subfolder}, the way from there. What makes no sense
/// is an error at the job's place.
void name_outputs(std::vector<batch::Job>& jobs, const std::vector<std::string>& templates,
                  const std::string& folder, Diagnostics& diagnostics);

/// Errors for jobs that `duet render` would refuse before it reads the scene: there is none, or
/// options have values that make no sense.
void check_jobs(const std::vector<batch::Job>& jobs, Program& program, Diagnostics& diagnostics);

}  // namespace duet
