#include "evaluate/batch/job_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/file_names.h"
#include "base/memory_limit.h"
#include "base/printable.h"
#include "base/system/signals.h"
#include "evaluate/report/partial_image.h"
#include "image/image_facts.h"

namespace duet::batch {

namespace fs = std::filesystem;

namespace {

/// More messages of one job nobody reads in a report.
constexpr size_t kMostMessages = 50;

/// The signal that asked a process to stop, or 0: it said so by its exit code (docs/batch.md), or
/// had not yet taken over the signal.
int stop_signal_of(const ChildEnd& end) {
  const int signal = end.signal != 0 ? end.signal : end.exit_code - 128;
  return is_stop_signal(signal) ? signal : 0;
}

std::string without_program(const std::string& line) {
  for (const std::string start : {"duet: error: ", "duet: warning: "})
    if (line.starts_with(start)) return line.substr(start.size());
  return line;
}

std::vector<std::string> lines_of(const ChildEnd& end) {
  std::vector<std::string> lines;
  const std::string text = printable(end.messages);
  for (size_t from = 0; from < text.size() && lines.size() < kMostMessages;) {
    const size_t to = std::min(text.find('\n', from), text.size());
    if (to > from) lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  if (end.has_more_messages || lines.size() == kMostMessages)
    lines.emplace_back("(more messages are left out)");
  return lines;
}

/// The first line about an error, or how the process ended.
std::string reason_of(const ChildEnd& end, const std::vector<std::string>& lines) {
  if (end.signal != 0) return fmt::format("killed by signal {}", end.signal);
  for (const std::string& line : lines)
    if (line.find("error: ") != line.npos) return without_program(line);
  return lines.empty() ? fmt::format("exit code {}", end.exit_code) : without_program(lines[0]);
}

/// What the statistics say; false if there are none.
bool read_statistics(const std::string& path, JobResult& result) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) return false;
  result.integrator = json.value("integrator", "");
  result.spp = json.value("spp", 0.0);
  result.memory_peak = json.value("memory_peak_bytes", 0.0);
  const auto error = json.find("error");
  if (error == json.end() || !error->is_object()) return true;
  const auto estimate = error->find("relative_standard_error");
  if (estimate != error->end() && estimate->is_number()) result.error = estimate->get<double>();
  result.error_is_bound = error->value("is_upper_bound", false);
  return true;
}

/// What the images of a job say that were there already.
void read_image_header(const Job& job, JobResult& result) {
  if (job.outputs.empty()) return;
  try {
    const ImageFacts facts = read_image_facts(job.outputs[0]);
    result.integrator = printable(facts.field("integrator"));
    result.spp = std::strtod(facts.field("spp").c_str(), nullptr);
    const std::string error = facts.field("relativeStandardError");
    if (!error.empty()) result.error = std::strtod(error.c_str(), nullptr);
    result.error_is_bound = facts.field("relativeRmseIsUpperBound") == "1";
  } catch (const ReadError&) {
    // It has been moved away meanwhile: nothing more is known.
  }
}

}  // namespace

std::string status_name(JobStatus status) {
  switch (status) {
    case JobStatus::not_started:
      return "not started";
    case JobStatus::rendered:
      return "rendered";
    case JobStatus::kept:
      return "kept";
    case JobStatus::interrupted:
      return "interrupted";
    case JobStatus::failed:
      break;
  }
  return "failed";
}

JobResult result_of(const Job& job, const ChildEnd& end, const std::string& statistics_file) {
  JobResult result;
  const std::vector<std::string> lines = lines_of(end);
  for (const std::string& line : lines) result.messages.push_back(without_program(line));
  const bool has_statistics = read_statistics(statistics_file, result);
  if (end.signal == 0 && end.exit_code == 0) {
    result.status = has_statistics ? JobStatus::rendered : JobStatus::kept;
    if (!has_statistics) read_image_header(job, result);
  } else if (const int signal = stop_signal_of(end); signal != 0) {
    result.status = JobStatus::interrupted;
    result.reason = fmt::format("interrupted by signal {}", signal);
  } else {
    result.status = JobStatus::failed;
    result.reason = reason_of(end, lines);
  }
  return result;
}

bool lacks_memory(const ChildEnd& end, bool kernel_ended) {
  if (is_kill_signal(end.signal)) return kernel_ended;
  if (end.signal != 0 || end.exit_code == 0) return false;
  for (const char* text : {kMemoryLimitVariable, "out of memory"})
    if (end.messages.find(text) != std::string::npos) return true;
  return false;
}

std::string image_to_show(const Job& job, const JobResult& result) {
  std::error_code ignored;
  std::string shown;
  for (const std::string& output : job.outputs) {
    const bool is_partial = result.status == JobStatus::interrupted;
    const std::string path =
        is_partial && fs::exists(partial_path(output), ignored) ? partial_path(output) : output;
    if (!(result.is_good() || is_partial) || !fs::exists(path, ignored)) continue;
    if (extension_of(path) != ".exr") return path;
    if (shown.empty()) shown = path;
  }
  return shown;
}

}  // namespace duet::batch
