#include "evaluate/slurm/submit.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "base/system/atomic_file.h"
#include "base/system/run_program.h"
#include "evaluate/slurm/sbatch.h"

namespace duet::slurm {

namespace {

namespace fs = std::filesystem;

/// Folders and files that go away again unless they are kept.
class NewFiles {
 public:
  ~NewFiles() {
    std::error_code ignored;
    for (auto path = made_.rbegin(); path != made_.rend(); ++path) fs::remove(*path, ignored);
  }
  void keep() { made_.clear(); }
  void make_folder(const fs::path& folder) {
    std::error_code error;
    if (folder.empty() || fs::is_directory(folder, error)) return;
    make_folder(folder.parent_path());
    if (fs::create_directory(folder, error)) made_.push_back(folder);
    if (error)
      throw std::runtime_error(
          fmt::format("the directory \"{}\" cannot be made: {}", folder.string(), error.message()));
  }
  void write(const std::string& path, const std::string& text) {
    std::error_code ignored;
    const bool is_new = !fs::exists(path, ignored);
    write_file_atomically(path, text);
    if (is_new) made_.emplace_back(path);
  }

 private:
  std::vector<fs::path> made_;
};

/// Submits a script; throws std::runtime_error if that fails.
SubmittedJob submitted(const std::vector<std::string>& command) {
  const ProgramEnd end = run_program(command);
  const auto in_a_line = [](std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.substr(0, 1000);
  };
  if (end.exit_code != 0)
    throw std::runtime_error(fmt::format("{} was not submitted: exit code {} of sbatch{}{}",
                                         command.back(), end.exit_code, end.err.empty() ? "" : ": ",
                                         in_a_line(end.err)));
  const auto job = submitted_job(end.out);
  if (!job)
    throw std::runtime_error(fmt::format("{}: sbatch printed \"{}\" instead of the number of a job",
                                         command.back(), in_a_line(end.out)));
  return *job;
}

}  // namespace

void submit(const ImageJob& job, Messages& messages) {
  NewFiles files;
  files.make_folder(job.folder);
  files.write(render_script_path(job), render_script(job));
  files.write(merge_script_path(job), merge_script(job));
  const SubmittedJob array = submitted(submit_render(job));
  files.keep();
  SubmittedJob merge;
  try {
    std::vector<std::string> command = submit_merge(job, array.number);
    if (!array.cluster.empty()) command.insert(command.end() - 1, "--clusters=" + array.cluster);
    merge = submitted(command);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(
        fmt::format("{}; the tasks are job {}, and nothing merges them", e.what(), array.number));
  }
  messages.info(
      "{}: {} tasks are job {}, their merge is job {}; {} has scripts, messages and raw films",
      job.merge_options[1], job.tasks, array.number, merge.number, job.folder);
}

}  // namespace duet::slurm
