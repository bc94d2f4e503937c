// The outcome of a batch for terminals.
#include <fmt/format.h>

#include <algorithm>

#include "base/percent.h"
#include "base/printable.h"
#include "base/seconds_text.h"
#include "base/terminal.h"
#include "evaluate/batch/reports.h"

namespace duet::batch {

namespace {

/// Warnings of a job that has its images; what a failed one says is more than that.
size_t warning_count(const JobResult& result) {
  return result.is_good() ? result.messages.size() : 0;
}

/// The text in so many columns, at their right.
std::string right(const std::string& text, size_t width) {
  return std::string(width - std::min(width, columns(text)), ' ') + text;
}

std::string left(const std::string& text, size_t width) {
  return text + std::string(width - std::min(width, columns(text)), ' ');
}

std::string table_line(const std::vector<std::string>& cells) {
  return fmt::format("{}{} {} {} {}  {}\n", left(cells[0], 12), right(cells[1], 8),
                     right(cells[2], 12), right(cells[3], 9), right(cells[4], 8), cells[5]);
}

}  // namespace

std::string spp_text(const JobResult& result) {
  return result.spp > 0 ? fmt::format("{:.6g}", result.spp) : "";
}

std::string error_text(const JobResult& result) {
  return result.error ? (result.error_is_bound ? "< " : "") + percent(*result.error) : "";
}

std::string job_name(const Job& job) {
  return printable(job.outputs.empty() ? job.scene : job.outputs[0]);
}

std::string outcome_summary(const BatchOutcome& batch) {
  std::string text = fmt::format("{} job{} in {}", batch.jobs.size(),
                                 batch.jobs.size() == 1 ? "" : "s", seconds_text(batch.seconds));
  const char* separator = ": ";
  for (const JobStatus status : {JobStatus::rendered, JobStatus::kept, JobStatus::failed,
                                 JobStatus::interrupted, JobStatus::not_started}) {
    const auto count = std::count_if(batch.results.begin(), batch.results.end(),
                                     [&](const JobResult& r) { return r.status == status; });
    if (count == 0) continue;
    text += fmt::format("{}{} {}", separator, count, status_name(status));
    separator = ", ";
  }
  return text;
}

std::string result_text(const JobResult& result) {
  std::string text;
  const auto add = [&](const std::string& part) {
    text += (text.empty() || part.empty() ? "" : ", ") + part;
  };
  if (!result.reason.empty()) add(result.reason);
  if (result.spp > 0) add(spp_text(result) + " spp");
  if (result.status != JobStatus::kept) add(seconds_text(result.seconds));
  if (result.error) add("error " + error_text(result));
  if (const size_t n = warning_count(result); n > 0)
    add(fmt::format("{} warning{}", n, n == 1 ? "" : "s"));
  return text;
}

std::string outcome_table(const BatchOutcome& batch) {
  std::string text = table_line({"status", "spp", "time", "error", "warnings", "image"});
  for (size_t i = 0; i < batch.jobs.size(); ++i) {
    const JobResult& r = batch.results[i];
    const size_t warnings = warning_count(r);
    text += table_line({status_name(r.status), spp_text(r),
                        r.seconds > 0 ? seconds_text(r.seconds) : "", error_text(r),
                        warnings > 0 ? fmt::to_string(warnings) : "",
                        job_name(batch.jobs[i]) + (r.reason.empty() ? "" : ": " + r.reason)});
  }
  return text;
}

}  // namespace duet::batch
