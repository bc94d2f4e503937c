// The outcome of a batch as JUnit's XML, which continuous integration servers read.
#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"
#include "evaluate/batch/reports.h"
#include "evaluate/web/page.h"

namespace duet::batch {

namespace {

std::string xml_text(const std::string& text) {
  return escape_markup(printable(text));
}

std::string case_element(const Job& job, const JobResult& r) {
  std::string xml = fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">\n",
                                xml_text(job.scene), xml_text(job_name(job)), r.seconds);
  if (r.status == JobStatus::kept)
    xml += "    <skipped message=\"the image was there already\"/>\n";
  else if (r.status != JobStatus::rendered)
    xml += fmt::format("    <failure type=\"{}\" message=\"{}\"/>\n", status_name(r.status),
                       xml_text(r.reason.empty() ? "the batch was interrupted before" : r.reason));
  if (r.spp > 0) {
    xml += fmt::format("    <system-out>{} spp {:g}", xml_text(r.integrator), r.spp);
    if (r.error) xml += fmt::format(" error {:.6g}", *r.error);
    xml += "</system-out>\n";
  }
  if (!r.messages.empty()) {
    xml += "    <system-err>";
    for (const std::string& message : r.messages) xml += xml_text(message) + "\n";
    xml += "</system-err>\n";
  }
  return xml + "  </testcase>\n";
}

}  // namespace

std::string outcome_junit(const BatchOutcome& batch) {
  const auto count = [&](auto is_counted) {
    return std::count_if(batch.results.begin(), batch.results.end(), is_counted);
  };
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"duet batch {}\" tests=\"{}\" "
      "failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{:.3f}\">\n",
      xml_text(batch.name), batch.jobs.size(), count([](const auto& r) { return !r.is_good(); }),
      count([](const auto& r) { return r.status == JobStatus::kept; }), batch.seconds);
  for (size_t i = 0; i < batch.jobs.size(); ++i)
    xml += case_element(batch.jobs[i], batch.results[i]);
  return xml + "</testsuite>\n";
}

}  // namespace duet::batch
