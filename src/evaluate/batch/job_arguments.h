// The command line of the process that renders a job.
#pragma once

#include <string>
#include <vector>

#include "evaluate/batch/job.h"

namespace duet::batch {

/// Whether the batch gives this option of `duet render` itself, so that no job can have it.
bool is_given_by_batch(const std::string& option);

/// The arguments of `duet` for a job: its own, and those by which the batch learns what came of it.
/// This is the only place where they are put together.
std::vector<std::string> render_arguments(const Job& job, int threads,
                                          const std::string& statistics_file);

/// The options of a job, each in one word.
std::vector<std::string> option_arguments(const Job& job);

/// The job's own part of them.
std::vector<std::string> job_arguments(const Job& job);

}  // namespace duet::batch
