#include "evaluate/batch/manifest.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/file_names.h"
#include "base/printable.h"
#include "base/readable.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/batch/manifest_fields.h"

namespace duet::batch {

namespace fs = std::filesystem;

ManifestFields::ManifestFields(std::string manifest, const std::vector<RenderOption>& options,
                               Diagnostics& diagnostics)
    : file_(std::make_shared<const std::string>(std::move(manifest))),
      folder_(fs::path(*file_).parent_path().string()),
      options_(options),
      diagnostics_(diagnostics) {}

std::optional<OptionKind> ManifestFields::kind(const std::string& name,
                                               const SourceLocation& where) {
  if (name == "scene") return OptionKind::single;
  if (name == "output") return OptionKind::repeatable;
  if (is_given_by_batch(name)) {
    diagnostics_.error(where, "a job cannot have \"{}\": duet batch gives this option itself",
                       name);
    return std::nullopt;
  }
  std::vector<std::string> known{"scene", "output"};
  for (const RenderOption& option : options_) {
    if (option.name == name) return option.kind;
    known.push_back(option.name);
  }
  diagnostics_.error(where,
                     "a job has no \"{}\"{}; it has scene, output and the long options of "
                     "duet render without dashes",
                     printable(name), did_you_mean(name, known));
  return std::nullopt;
}

std::string ManifestFields::in_folder(const std::string& path) const {
  return fs::path(path).is_relative() ? (fs::path(folder_) / path).lexically_normal().string()
                                      : path;
}

void ManifestFields::set(Job& job, const std::string& name, OptionKind kind,
                         std::vector<std::string> values) {
  std::erase(values, "");
  if (values.empty()) return;
  for (const std::string& value : values)
    if (value.find('\0') != std::string::npos) {
      // It would end there when it is handed to the process of the job.
      diagnostics_.error(job.where, "\"{}\" has a character of code 0: {}", name, printable(value));
      return;
    }
  if (name == "scene") {
    // Standard input holds one scene; a batch has many.
    if (values[0] == "-") diagnostics_.error(job.where, "\"-\": a job needs a scene file");
    job.scene = in_folder(values[0]);
    return;
  }
  if (name == "output") {
    job.outputs = std::move(values);
    return;
  }
  const bool is_alone = values == std::vector<std::string>{"true"};
  if (kind == OptionKind::flag && !is_alone) {
    if (values != std::vector<std::string>{"false"})
      diagnostics_.error(job.where, "\"{}\" is true or false, not \"{}\"", name,
                         printable(values[0]));
    return;
  }
  if (is_alone && (kind == OptionKind::flag || kind == OptionKind::optional_value)) values.clear();
  if (name == "path")
    for (std::string& folder : values) folder = in_folder(folder);
  job.options.push_back({name, std::move(values)});
}

void ManifestFields::finish(Job job, std::vector<Job>& jobs) {
  if (job.scene.empty()) diagnostics_.error(job.where, "this job has no scene");
  jobs.push_back(std::move(job));
}

std::vector<Job> read_manifest(const std::string& path, const std::vector<RenderOption>& options,
                               Diagnostics& diagnostics) {
  std::vector<Job> jobs;
  ManifestFields fields(path, options, diagnostics);
  const SourceLocation whole{fields.file(), 0, 0};
  const std::string extension = extension_of(path);
  if (const std::string why = unreadable_reason(path); !why.empty()) {
    diagnostics.error(whole, "it cannot be read: {}", why);
  } else if (extension != ".csv" && extension != ".jsonl") {
    diagnostics.error(whole, "a list of jobs is a .csv or .jsonl file, or a folder with scenes");
  } else {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (file.bad())
      diagnostics.error(whole, "it cannot be read to its end");
    else if (extension == ".csv")
      read_manifest_csv(text, fields, jobs);
    else
      read_manifest_jsonl(text, fields, jobs);
    if (jobs.empty() && !diagnostics.has_errors()) diagnostics.error(whole, "there are no jobs");
  }
  return jobs;
}

}  // namespace duet::batch
