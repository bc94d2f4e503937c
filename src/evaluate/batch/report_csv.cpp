// The outcome of a batch for spreadsheets and programs.
#include <fmt/ranges.h>

#include "evaluate/batch/reports.h"
#include "evaluate/report/csv_field.h"

namespace duet::batch {

std::string outcome_csv(const BatchOutcome& batch) {
  std::string csv =
      "job,place,scene,output,status,integrator,spp,seconds,threads,error,error_is_bound,"
      "memory_peak_bytes,warnings,message\r\n";
  for (size_t i = 0; i < batch.jobs.size(); ++i) {
    const Job& job = batch.jobs[i];
    const JobResult& r = batch.results[i];
    const bool was_run = r.status != JobStatus::not_started;
    const std::string fields[] = {
        fmt::to_string(i + 1),
        csv_field(job.where.to_string()),
        csv_field(job.scene),
        csv_field(fmt::format("{}", fmt::join(job.outputs, ";"))),
        status_name(r.status),
        csv_field(r.integrator),
        r.spp > 0 ? fmt::format("{}", r.spp) : "",
        was_run ? fmt::format("{:.3f}", r.seconds) : "",
        was_run ? fmt::to_string(r.threads) : "",
        r.error ? fmt::format("{}", *r.error) : "",
        r.error ? (r.error_is_bound ? "true" : "false") : "",
        r.memory_peak > 0 ? fmt::format("{:.0f}", r.memory_peak) : "",
        was_run && r.is_good() ? fmt::to_string(r.messages.size()) : "",
        csv_field(r.reason.empty() ? fmt::format("{}", fmt::join(r.messages, "\n")) : r.reason)};
    for (const std::string& field : fields) csv += (&field == fields ? "" : ",") + field;
    csv += "\r\n";
  }
  return csv;
}

}  // namespace duet::batch
