// What came of a batch, in several forms.
#pragma once

#include <string>
#include <vector>

#include "base/messages.h"
#include "base/system/atomic_file.h"
#include "evaluate/batch/job.h"
#include "evaluate/batch/job_result.h"

namespace duet::batch {

/// A batch with its results, one for each job.
struct BatchOutcome {
  const std::string& name;  ///< of the manifest or folder
  const std::vector<Job>& jobs;
  const std::vector<JobResult>& results;
  const std::string& command_line;
  double seconds = 0;
};

/// "1000 jobs in 1 min 2 s: 900 rendered, 97 kept, 3 failed".
std::string outcome_summary(const BatchOutcome& batch);
/// "64 spp, 1.2 s, error 3.1 %, 2 warnings", as far as it is known.
std::string result_text(const JobResult& result);
/// The samples and the estimate of the error; "" where they are not known.
std::string spp_text(const JobResult& result);
std::string error_text(const JobResult& result);
/// What a job is called: its first output.
std::string job_name(const Job& job);

/// A line for each job under a line with the names of the columns.
std::string outcome_table(const BatchOutcome& batch);
/// RFC 4180 with these columns: job (from 1), place, scene, output, status, integrator, spp,
/// seconds, threads, error, error_is_bound, memory_peak_bytes, warnings, message.
std::string outcome_csv(const BatchOutcome& batch);
/// JUnit's XML: a test case for each job; one that is kept is skipped, one that fails, or has no
/// finished image after an interrupt, is a failure.
std::string outcome_junit(const BatchOutcome& batch);
/// A page with a table of all jobs and small images that open the large ones. It is written piece
/// by piece: of images no more than one is in memory.
void write_outcome_page(const BatchOutcome& batch, AtomicFile& file);

/// Files for what is above; "" for those that are not wanted.
struct ReportPaths {
  std::string csv, junit, page;
};
/// Finds out before rendering what would be a pity to find out afterwards: an error at its job for
/// an image that cannot be written; throws UsageError for a report that cannot, or whose file is
/// the list, an image or another report.
void check_files(const std::string& list, const std::vector<Job>& jobs, const ReportPaths& paths,
                 Diagnostics& diagnostics);
/// Writes them. Whether all are there; a message says of each that is not why.
bool write_reports(const BatchOutcome& batch, const ReportPaths& paths, Messages& messages);

}  // namespace duet::batch
