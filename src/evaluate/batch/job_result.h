// What came of a job.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/system/child_process.h"
#include "evaluate/batch/job.h"

namespace duet::batch {

enum class JobStatus {
  not_started,  ///< the batch was interrupted before
  rendered,
  kept,         ///< its images were there already, made with the same settings
  interrupted,  ///< there may be partial images
  failed,
};

/// "rendered", "not started" …
std::string status_name(JobStatus status);

struct JobResult {
  JobStatus status = JobStatus::not_started;
  /// Why it is neither rendered nor kept; "" otherwise.
  std::string reason;
  /// Warnings and errors, those of the file with their places; printable, and limited in number.
  std::vector<std::string> messages;
  int threads = 0;
  double seconds = 0;           ///< from start to end of its process
  std::string integrator;       ///< that was used; "" if not known
  double spp = 0;               ///< 0 if not known
  std::optional<double> error;  ///< estimate of the relative standard error
  bool error_is_bound = false;  ///< the error is at most that
  double memory_peak = 0;       ///< in bytes; 0 if not known

  /// Whether the batch has what it is for.
  bool is_good() const { return status == JobStatus::rendered || status == JobStatus::kept; }
};

/// What a process says of its job by how it ended, what it wrote, and the statistics that it left,
/// which are not there if the images were there already.
JobResult result_of(const Job& job, const ChildEnd& end, const std::string& statistics_file);

/// Whether a job failed for lack of memory, going by how its process ended. `kernel_ended` says
/// that the kernel has ended processes for that meanwhile.
bool lacks_memory(const ChildEnd& end, bool kernel_ended);

/// The file that shows the job's image best: one for display, if there is one; after an interrupt
/// the partial image; "" if there is none.
std::string image_to_show(const Job& job, const JobResult& result);

}  // namespace duet::batch
