// What the jobs of `duet batch` have to do with the options of `duet render`: its own parser is
// asked which there are and what their values may be.
#pragma once

#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet {

struct Program;

/// The jobs of a manifest, or of all scenes below a folder. `for_all` are arguments of `duet
/// render` that are for all jobs. Outputs are made of their templates, those of jobs that have none
/// of `templates`: {scene}, {folder} and the names of the job's options are filled in, and of
/// scenes that were found below a folder also {subfolder}, the way from there.
///
/// Throws UsageError for `for_all`. All else that is wrong is an error at the job's place: what
/// read_manifest() says, outputs that make no sense or that two jobs have, and jobs that `duet
/// render` would refuse before it reads the scene.
std::vector<batch::Job> list_jobs(const std::string& list, const std::vector<std::string>& for_all,
                                  const std::vector<std::string>& templates, Program& program,
                                  Diagnostics& diagnostics);

}  // namespace duet
