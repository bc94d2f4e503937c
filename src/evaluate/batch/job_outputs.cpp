#include "evaluate/batch/job_outputs.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/failures.h"
#include "evaluate/render/file_uses.h"
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
  return image_path(fill_in("-o", pattern, placeholders), names,
                    "." + (format.empty() ? "exr" : format));
}

/// The images and the raw film of a job, as far as the list says their names.
std::vector<std::string> files_of_job(const Job& job) {
  std::vector<std::string> files = job.outputs;
  if (const std::string pattern = job.value("raw"); !pattern.empty()) try {
      OutputNames names = output_names(job.scene);
      const auto said = [&](const char* option) {
        const std::string value = job.value(option);
        return value.empty() ? fmt::format("{{{}}}", option) : value;
      };
      names.integrator = said("integrator"), names.spp = said("spp"), names.seed = said("seed");
      files.push_back(output_path(pattern, names, kRawExtension));
    } catch (const UsageError&) {
      // The check of the job's options says so.
    }
  return files;
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

void check_outputs_differ(const std::vector<Job>& jobs, Diagnostics& diagnostics) {
  std::map<std::string, const Job*> readers, writers;
  for (const Job& job : jobs)
    for (const std::string& path : {job.scene, job.value("resume")})
      if (!path.empty()) readers.try_emplace(file_behind(path), &job);
  for (const Job& job : jobs)
    for (const std::string& path : files_of_job(job)) {
      const std::string file = file_behind(path);
      const auto [writer, is_new] = writers.try_emplace(file, &job);
      if (!is_new)
        diagnostics.error(job.where,
                          "{} is written by two jobs, the other is {}; a template with {{scene}}, "
                          "{{folder}} or the name of an option tells them apart",
                          path, writer->second->where.to_string());
      const auto reader = readers.find(file);
      if (reader != readers.end() && reader->second != &job)
        diagnostics.error(job.where, "{} is read by another job, {}", path,
                          reader->second->where.to_string());
    }
}

}  // namespace duet::batch
