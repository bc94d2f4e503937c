#include "evaluate/batch/job_outputs.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/failures.h"
#include "evaluate/render/output.h"
#include "evaluate/render/placeholders.h"

namespace duet::batch {

namespace {

namespace fs = std::filesystem;

std::string output_of_job(const Job& job, const std::string& pattern, const std::string& folder) {
  if (pattern == "-") throw UsageError("-o -: standard output holds one image");
  const OutputNames names = output_names(job.scene);
  Placeholders placeholders{{"scene", names.scene}, {"folder", names.folder}};
  if (!folder.empty())
    placeholders.emplace_back("subfolder",
                              fs::path(job.scene)
                                  .parent_path()
                                  .lexically_normal()
                                  .lexically_relative(fs::path(folder).lexically_normal())
                                  .string());
  for (const JobOption& option : job.options) {
    std::string text = fmt::format("{}", fmt::join(option.values, ","));
    // A value makes no folders.
    std::replace(text.begin(), text.end(), '/', '_');
    placeholders.emplace_back(option.name, text);
  }
  const std::string format = job.value("format");
  return output_path(fill_in("-o", pattern, placeholders), names,
                     "." + (format.empty() ? "exr" : format));
}

}  // namespace

void name_outputs(std::vector<Job>& jobs, const std::vector<std::string>& templates,
                  const std::string& folder, Diagnostics& diagnostics) {
  for (Job& job : jobs) {
    if (job.outputs.empty()) job.outputs = templates;
    if (job.outputs.empty()) job.outputs = {""};
    try {
      for (std::string& output : job.outputs) output = output_of_job(job, output, folder);
    } catch (const UsageError& e) {
      diagnostics.error(job.where, "{}", e.what());
      job.outputs.clear();
    }
  }
}

}  // namespace duet::batch
