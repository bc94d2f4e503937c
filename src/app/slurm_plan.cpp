#include "app/slurm_plan.h"

#include <algorithm>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/job_options.h"
#include "app/program.h"
#include "app/render_grammar.h"
#include "base/file_names.h"
#include "base/system/process.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/render/placeholders.h"
#include "evaluate/slurm/plan.h"
#include "evaluate/slurm/sbatch.h"

namespace duet {

namespace {

/// Guards against slips of the pen.
constexpr uint64_t kMostTasks = 1000000;
/// Options of `duet render` that its tasks cannot have, and why.
const std::pair<const char*, const char*> kRefused[] = {
    {"--time",
     "samples that follow from it cannot be cut into slices; before --, --time is the "
     "time limit of Slurm"},
    {"--target-error", "samples that follow from it cannot be cut into slices"},
    {"--require-target", "there is no --target-error"},
    {"--raw", "each task has a raw film of its own"},
    {"--samples", "each task has samples of its own"},
    {"--slice", "each task has a slice of its own"},
    {"--resume", "each task goes on from its own raw film"},
    {"--format", "the name behind -o says it"},
    {"--skip-existing", "tasks write no images"},
    {"--keep-partial-name", "tasks write no images"},
    {"--denoise", "tasks write no images"},
    {"--cryptomatte", "the mattes of slices cannot be put together"},
    {"--stats", "all tasks would write this file"},
    {"--log", "all tasks would write this file"},
    {"--display", "no task has an image, and they run elsewhere"},
    {"--live", "no task has an image, and they run elsewhere"},
    {"--live-port", "no task has an image, and they run elsewhere"},
};

/// Reads what stands behind `--`, and which scenes stand before it.
class TaskOptionParser {
 public:
  TaskOptionParser(const SlurmOptions& options, Program& program)
      : options_(options), render_(program) {}

  slurm::ArrayRequest request() {
    slurm::ArrayRequest request;
    request.tasks = uint32_t(parse_whole("--tasks", options_.tasks, 1, kMostTasks));
    request.sbatch_options =
        slurm::sbatch_options(options_.time, options_.partition, options_.sbatch);
    // Scenes begin with no dash, and of options only those behind -- are operands.
    const auto first = std::find_if(
        options_.operands.begin(), options_.operands.end(),
        [](const std::string& operand) { return operand.size() > 1 && operand[0] == '-'; });
    request.render_options.assign(first, options_.operands.end());
    if (first == options_.operands.begin())
      throw UsageError(
          "slurm: there is no scene before the options of duet render; a file whose name begins "
          "with a dash is called ./-name");
    request.render = parse_operands();
    if (!request.render.checkpoint)
      request.render_options.insert(request.render_options.end(), {"--checkpoint", "60s"});
    request.has_threads = render_.command.count("--threads") > 0;
    request.outputs = options_.outputs;
    const std::string own = own_program();
    request.program = !options_.program.empty() ? options_.program : own.empty() ? "duet" : own;
    return request;
  }

 private:
  RenderOptions parse_operands() {
    std::vector<std::string> words = options_.operands;
    for (const std::string& output : options_.outputs) words.insert(words.end(), {"-o", output});
    render_.command.set_help_flag();
    try {
      render_.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
      throw UsageError(fmt::format("options of duet render: {}", e.what()));
    }
    check_task_options();
    RenderOptions render = render_.parser.finish();
    check_defines(render.read);
    return render;
  }

  void check_task_options() const {
    for (const auto& [option, reason] : kRefused)
      if (render_.command.count(option) > 0)
        throw UsageError(fmt::format("{}, an option of the tasks: {}", option, reason));
    if (render_.command.count("--output") > options_.outputs.size())
      throw UsageError("-o, an option of the tasks: they write no images; it goes before --");
    for (const std::string& word : options_.operands)
      if (word.find(slurm::kSlice) != word.npos)
        throw UsageError(fmt::format("{}: {} has a meaning in the scripts", word, slurm::kSlice));
  }

  const SlurmOptions& options_;
  RenderGrammar render_;
};

std::vector<slurm::ImageJob> plan_scenes(const SlurmOptions& options, Program& program) {
  const slurm::ArrayRequest request = TaskOptionParser(options, program).request();
  std::vector<slurm::ImageJob> jobs;
  for (const std::string& file : request.render.read.scenes) try {
      jobs.push_back(slurm::plan_job(file, request, program.log));
    } catch (const SceneFailure& e) {
      throw std::runtime_error(e.is_printed() ? file + " cannot be rendered: nothing is submitted"
                                              : file + ": " + e.what());
    }
  return jobs;
}

/// The operands of a call with a list are the list, and options for all of its jobs.
std::vector<slurm::ImageJob> plan_list(const SlurmOptions& options, Program& program) {
  const std::string& list = options.operands[0];
  Diagnostics diagnostics;
  const std::vector<batch::Job> listed =
      list_jobs(list, {options.operands.begin() + 1, options.operands.end()}, options.outputs,
                program, diagnostics);
  try {
    report(diagnostics, false, program.log);
  } catch (const SceneFailure&) {
    throw UsageError(list + ": nothing is submitted");
  }
  std::vector<slurm::ImageJob> jobs;
  for (const batch::Job& job : listed) try {
      SlurmOptions one = options;
      one.outputs.clear();
      for (const std::string& output : job.outputs) one.outputs.push_back(as_pattern(output));
      one.operands = batch::option_arguments(job);
      one.operands.insert(one.operands.begin(), as_operand(job.scene));
      jobs.push_back(plan_scenes(one, program).at(0));
    } catch (const UsageError& e) {
      throw UsageError(fmt::format("{}: {}", job.where.to_string(), e.what()));
    }
  return jobs;
}

}  // namespace

std::vector<slurm::ImageJob> plan_slurm_jobs(const SlurmOptions& options, Program& program) {
  const std::string kind = extension_of(options.operands.at(0));
  std::vector<slurm::ImageJob> jobs = kind == ".csv" || kind == ".jsonl"
                                          ? plan_list(options, program)
                                          : plan_scenes(options, program);
  slurm::check_folders_differ(jobs);
  return jobs;
}

}  // namespace duet
