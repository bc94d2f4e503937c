// What `duet slurm` is to submit.
#pragma once

#include <string>
#include <vector>

#include "evaluate/slurm/scripts.h"

namespace duet {

struct Program;

/// The command line of `duet slurm`.
struct SlurmOptions {
  std::vector<std::string> operands, outputs, sbatch;
  std::string tasks, time, partition, program;
  bool dry_run = false, quiet = false;
};

/// The jobs of all scenes, or of a list as for `duet batch` (.csv, .jsonl). The scenes are read,
/// but not rendered. Throws UsageError for options that make no sense, and std::runtime_error if a
/// scene cannot be rendered.
std::vector<slurm::ImageJob> plan_slurm_jobs(const SlurmOptions& options, Program& program);

}  // namespace duet
