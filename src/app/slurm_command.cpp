// duet slurm: scenes in, jobs of a cluster out, which render their images.
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/program.h"
#include "app/slurm_plan.h"
#include "base/system/run_program.h"
#include "evaluate/slurm/submit.h"

namespace duet {

namespace {

void print(const slurm::ImageJob& job) {
  fmt::print("# {}\n{}\n# {}\n{}\n# To submit them:\n{}", slurm::render_script_path(job),
             slurm::render_script(job), slurm::merge_script_path(job), slurm::merge_script(job),
             slurm::submit_script(job));
}

int submit_all(const SlurmOptions& options, Program& program) {
  if (options.quiet) program.log.set_level(Log::Level::quiet);
  if (!options.dry_run && find_program("sbatch").empty())
    throw std::runtime_error(
        "there is no sbatch on this machine, by which jobs are submitted to Slurm; --dry-run "
        "prints the scripts");
  const std::vector<slurm::ImageJob> jobs = plan_slurm_jobs(options, program);
  for (const slurm::ImageJob& job : jobs)
    options.dry_run ? print(job) : slurm::submit(job, program.log);
  return kSuccess;
}

}  // namespace

void add_slurm_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand(
      "slurm", "Render scenes on a cluster: submit job arrays and merges to Slurm");
  const auto o = std::make_shared<SlurmOptions>();
  // The scenes take all operands, so those that follow, too: plan_slurm_jobs() tells them apart.
  c->add_option("scene", o->operands,
                "Scene files and folders, as for duet render, or a list of jobs as for duet batch: "
                ".csv or .jsonl")
      ->required();
  c->add_option("options", o->operands, "Behind --: options of duet render for the tasks");
  c->add_option("--tasks", o->tasks, "Tasks per scene; each renders as many of its samples")
      ->required();
  c->add_option("-o,--output", o->outputs,
                "Image that the merge writes, as for duet render; beside it is the folder "
                "NAME.slurm; repeatable (default: {scene}.exr here)")
      ->allow_extra_args(false);
  c->add_flag("--dry-run", o->dry_run, "Print the scripts and do nothing");
  c->add_flag("-q,--quiet", o->quiet, "Errors and warnings only");
  c->option_defaults()->group("Options of Slurm, for tasks and merge");
  c->add_option("--time", o->time,
                "Time limit of a job, as Slurm writes it: MINUTES, H:MM:SS or DAYS-HOURS. (The "
                "--time of duet render is another, and cannot be cut into slices)");
  c->add_option("--partition", o->partition, "Partition, or several with commas");
  c->add_option("--sbatch", o->sbatch,
                "Further options of sbatch, such as --mem=8G or --cpus-per-task=16; repeatable")
      ->allow_extra_args(false);
  c->add_option("--program", o->program,
                "duet on the nodes (default: this one, by its whole path)");
  c->footer(
      "A task takes as many threads as Slurm gives it CPUs. It writes its raw film every 60 s (or "
      "as --checkpoint behind -- says), when Slurm stops it and 60 s before its time limit, and "
      "goes on from it when it is requeued. The merge waits for the ends of all tasks. What is "
      "lost is in NAME.slurm/merge.log, with the commands that render it; the image is the mean "
      "of what is there. Repeat the whole command to render what is missing.\n"
      "Examples:\n"
      "  duet slurm room.xml --tasks 64 --time 1:00:00 --partition cpu -o room.exr\n"
      "  duet slurm room.xml --tasks 64 --sbatch --cpus-per-task=16 -- --spp 4096 -i bdpt\n"
      "  duet slurm scenes/*/scene.xml --tasks 8 -o 'images/{scene}.exr' --dry-run\n"
      "  duet slurm jobs.csv --tasks 8            its first row may be scene,spp,output\n"
      "Exit codes: 0 all are submitted; 1 a scene cannot be read, there is no sbatch, or it "
      "failed; 2 wrong usage.");
  c->callback([o, &program] { program.exit_code = submit_all(*o, program); });
}

}  // namespace duet
