#include "evaluate/slurm/scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/failures.h"
#include "base/file_names.h"
#include "base/shell.h"
#include "evaluate/slurm/sbatch.h"

namespace duet::slurm {

namespace {

/// Of the slice kSlice. It is told apart from those of other cuts, which must not be merged.
std::string film(const ImageJob& job) {
  return fmt::format("{}/{}spp-slice-{}-of-{}.exr", job.folder, job.spp, kSlice, job.tasks);
}

/// What a task does, with kSlice.
std::vector<std::string> slice_command(const ImageJob& job) {
  std::vector<std::string> words{job.program, "render", as_operand(job.scene)};
  words.insert(words.end(), job.render_options.begin(), job.render_options.end());
  for (const std::string& w : {std::string("--slice"), fmt::format("{}/{}", kSlice, job.tasks),
                               std::string("--raw"), film(job)})
    words.push_back(w);
  return words;
}

/// Quoted for the shell, but for kSlice, in whose place `text` stands.
std::string quoted_with_slice(const std::string& word, const std::string& text) {
  std::string quoted;
  size_t from = 0;
  for (size_t at; (at = word.find(kSlice, from)) != std::string::npos; from = at + kSlice.size()) {
    if (at > from) quoted += shell_quoted(word.substr(from, at - from));
    quoted += text;
  }
  const std::string rest = word.substr(from);
  return rest.empty() && from > 0 ? quoted : quoted + shell_quoted(rest);
}

/// Words from the second option on begin a line.
std::string in_lines(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) {
    const bool is_option = words[i].starts_with("--");
    text += (i == 0 ? "" : is_option ? " \\\n  " : " ") + words[i];
  }
  return text;
}

std::string sbatch_line(const std::string& option, const std::string& value) {
  return fmt::format("#SBATCH --{}={}\n", option, shell_quoted(value));
}

std::string further_options(const ImageJob& job) {
  std::string text;
  for (const std::string& option : job.sbatch_options) text += "#SBATCH " + option + "\n";
  return text;
}

}  // namespace

void name_job(ImageJob& job, const std::string& image) {
  const std::filesystem::path path = image;
  job.name = path.stem().string();
  job.folder = as_operand(std::filesystem::path(path).replace_extension(".slurm").string());
  const auto is_odd = [](char c) {
    return c == '\\' || c == '{' || c == '}' || static_cast<unsigned char>(c) < ' ';
  };
  if (std::any_of(job.folder.begin(), job.folder.end(), is_odd))
    throw UsageError(fmt::format(
        "-o {}: names in Slurm's scripts have no backslash, brace or control character", image));
}

std::string render_script_path(const ImageJob& job) {
  return job.folder + "/render.sh";
}

std::string merge_script_path(const ImageJob& job) {
  return job.folder + "/merge.sh";
}

std::string render_script(const ImageJob& job) {
  std::vector<std::string> words;
  for (const std::string& word : slice_command(job))
    words.push_back(quoted_with_slice(word, "\"$SLURM_ARRAY_TASK_ID\""));
  if (!job.has_threads) words.push_back("--threads \"$SLURM_CPUS_ON_NODE\"");
  return fmt::format(
             "#!/bin/bash\n"
             "# Renders one of {} slices of the samples in each task, to a raw film. Names are "
             "meant "
             "from the folder where\n"
             "# this is submitted. A task that begins again goes on from its raw film.\n",
             job.tasks) +
         sbatch_line("job-name", job.name) + fmt::format("#SBATCH --array=1-{}\n", job.tasks) +
         sbatch_line("output", output_pattern(job.folder) + "/slice-%a.log") +
         fmt::format(
             "#SBATCH --open-mode=append\n"
             "#SBATCH --requeue\n"
             "#SBATCH --signal=B:TERM@{}\n",
             kSecondsToStop) +
         further_options(job) +
         "# By exec it is duet that Slurm's signals reach: it writes the raw film and ends.\n"
         "exec " +
         in_lines(words) + "\n";
}

std::string merge_script(const ImageJob& job) {
  std::vector<std::string> words{job.program, "merge"};
  for (std::string& word : words) word = shell_quoted(word);
  words.push_back(quoted_with_slice(film(job), fmt::format("{{1..{}}}", job.tasks)));
  for (const std::string& option : job.merge_options) words.push_back(shell_quoted(option));
  std::string command;
  for (const std::string& word : slice_command(job))
    command += (command.empty() ? "" : " ") + quoted_with_slice(word, kSlice);
  words.push_back(fmt::format("--slices {} --spp {}", job.tasks, job.spp));
  words.push_back("--slice-command " + shell_quoted(command));
  return "#!/bin/bash\n"
         "# Adds up the raw films that the tasks have left, and names the slices that lack "
         "samples.\n" +
         sbatch_line("job-name", job.name + "-merge") +
         sbatch_line("output", output_pattern(job.folder) + "/merge.log") + "#SBATCH --requeue\n" +
         further_options(job) + "exec " + in_lines(words) + "\n";
}

std::string submit_script(const ImageJob& job) {
  return fmt::format(
      "#!/bin/bash\n"
      "# Submits the tasks, and the merge that waits for their ends, whatever came of them.\n"
      "job=$({}) &&\n  sbatch --dependency=afterany:\"${{job%%;*}}\" {}\n",
      shell_quoted(submit_render(job)), shell_quoted(merge_script_path(job)));
}

std::vector<std::string> submit_render(const ImageJob& job) {
  return {"sbatch", "--parsable", render_script_path(job)};
}

std::vector<std::string> submit_merge(const ImageJob& job, const std::string& dependency) {
  return {"sbatch", "--parsable", "--dependency=afterany:" + dependency, merge_script_path(job)};
}

}  // namespace duet::slurm
