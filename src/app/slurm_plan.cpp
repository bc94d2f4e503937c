#include "app/slurm_plan.h"

#include <algorithm>
#include <set>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/job_options.h"
#include "app/program.h"
#include "app/render_grammar.h"
#include "base/file_names.h"
#include "base/run_program.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/render/file_settings_text.h"
#include "evaluate/render/output.h"
#include "evaluate/render/scene_method.h"
#include "evaluate/render/scene_operand.h"
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

/// Makes the jobs of one call.
class SlurmPlan {
 public:
  SlurmPlan(const SlurmOptions& options, Program& program)
      : options_(options), program_(program), render_(program) {}

  std::vector<slurm::ImageJob> jobs() {
    read_options();
    std::vector<slurm::ImageJob> jobs;
    for (const std::string& file : render_options_.read.scenes) try {
        jobs.push_back(plan_job(file));
      } catch (const SceneFailure& e) {
        throw std::runtime_error(e.is_printed() ? file + " cannot be rendered: nothing is submitted"
                                                : file + ": " + e.what());
      }
    return jobs;
  }

 private:
  void read_options() {
    tasks_ = uint32_t(parse_whole("--tasks", options_.tasks, 1, kMostTasks));
    sbatch_ = slurm::sbatch_options(options_.time, options_.partition, options_.sbatch);
    // Scenes begin with no dash, and of options only those behind -- are operands.
    const auto first = std::find_if(
        options_.operands.begin(), options_.operands.end(),
        [](const std::string& operand) { return operand.size() > 1 && operand[0] == '-'; });
    task_options_.assign(first, options_.operands.end());
    if (first == options_.operands.begin())
      throw UsageError("slurm: there is no scene before the options of duet render");
    std::vector<std::string> words = options_.operands;
    for (const std::string& output : options_.outputs) words.insert(words.end(), {"-o", output});
    render_.command.set_help_flag();
    try {
      render_.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
      throw UsageError(fmt::format("options of duet render: {}", e.what()));
    }
    check_task_options();
    render_options_ = render_.parser.finish();
    check_defines(render_options_.read);
    if (!render_options_.checkpoint)
      task_options_.insert(task_options_.end(), {"--checkpoint", "60s"});
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

  slurm::ImageJob plan_job(const std::string& file) {
    if (file == kStandardInput) throw UsageError("-: tasks have no standard input");
    SceneDescription scene = load_scene(file, render_options_.read, program_.log).description;
    const SensorDescription& sensor = chosen_sensor(scene, render_options_.sensor, file);
    // What every task would find out.
    chosen_method(scene, sensor, render_options_, program_.log);
    const int spp = render_options_.budget.spp.value_or(sensor.sampler.sample_count);
    if (int64_t(tasks_) > spp)
      throw UsageError(
          fmt::format("--tasks {}: {} is rendered with {} samples per pixel, which "
                      "have no {} parts",
                      options_.tasks, file, spp, tasks_));
    OutputNames names = output_names(file);
    names.integrator = integrator_name(scene.integrator);
    names.spp = fmt::to_string(spp);
    names.seed = fmt::to_string(render_options_.seed.value_or(sensor.sampler.seed));
    return job_of(file, names, uint32_t(spp));
  }

  slurm::ImageJob job_of(const std::string& file, const OutputNames& names, uint32_t spp) const {
    slurm::ImageJob job;
    const std::string own = own_program();
    job.program = !options_.program.empty() ? options_.program : own.empty() ? "duet" : own;
    job.scene = file;
    job.spp = spp, job.tasks = tasks_;
    job.render_options = task_options_;
    job.has_threads = render_.command.count("--threads") > 0;
    // As the scene says it now: all tasks have to mean the same slices.
    if (!render_options_.budget.spp)
      job.render_options.insert(job.render_options.end(), {"--spp", names.spp});
    std::vector<std::string> patterns = options_.outputs;
    if (patterns.empty()) patterns.emplace_back();
    for (const std::string& pattern : patterns)
      job.merge_options.insert(job.merge_options.end(), {"-o", output_path(pattern, names)});
    for (const std::string& argument : file_arguments(render_options_.files))
      job.merge_options.push_back(argument);
    slurm::name_job(job, job.merge_options[1]);
    job.sbatch_options = sbatch_;
    return job;
  }

  const SlurmOptions& options_;
  Program& program_;
  RenderGrammar render_;
  RenderOptions render_options_;
  uint32_t tasks_ = 1;
  std::vector<std::string> task_options_, sbatch_;
};

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
      one.outputs = job.outputs;
      one.operands = batch::option_arguments(job);
      one.operands.insert(one.operands.begin(), job.scene);
      jobs.push_back(SlurmPlan(one, program).jobs().at(0));
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
                                          : SlurmPlan(options, program).jobs();
  std::set<std::string> folders;
  for (const slurm::ImageJob& job : jobs)
    if (!folders.insert(job.folder).second)
      throw UsageError(fmt::format("-o: two images have the folder {}", job.folder));
  return jobs;
}

}  // namespace duet
