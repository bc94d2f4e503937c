// duet batch: many scenes, each in a process of its own.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/job_display.h"
#include "app/job_options.h"
#include "app/program.h"
#include "base/memory_limit.h"
#include "base/shell.h"
#include "base/system/signals.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/batch/job_queue.h"
#include "evaluate/batch/reports.h"

namespace duet {

namespace {

using namespace batch;

/// More of one manifest nobody reads.
constexpr size_t kMostErrors = 100;

struct BatchOptions {
  std::string list;
  std::vector<std::string> for_all, outputs;
  std::string jobs, threads, report, junit, csv, progress = "auto";
  bool dry_run = false, quiet = false, verbose = false;
};

/// Carries out one call.
class BatchCommand {
 public:
  BatchCommand(const BatchOptions& options, Program& program)
      : options_(options), program_(program), log_(program.log) {}

  int run() {
    log_.set_level(message_level(options_.quiet, options_.verbose));
    const QueueSettings settings = queue_settings();
    jobs_ = list_jobs(options_.list, options_.for_all, options_.outputs, program_, diagnostics_);
    if (report_errors()) return kWrongUsage;
    if (options_.dry_run) {
      for (const Job& job : jobs_) fmt::print("duet {}\n", shell_quoted(job_arguments(job)));
      return kSuccess;
    }
    check_files(options_.list, jobs_, reports(), diagnostics_);
    if (report_errors()) return kWrongUsage;
    return render(settings);
  }

 private:
  ReportPaths reports() const { return {options_.csv, options_.junit, options_.report}; }

  QueueSettings queue_settings() {
    QueueSettings settings;
    settings.threads = options_.threads.empty()
                           ? program_.threads()
                           : int(parse_whole("--threads", options_.threads, 1, kMaxThreads));
    if (!options_.jobs.empty())
      settings.jobs_at_once = int(parse_whole("--jobs", options_.jobs, 1, kMaxThreads));
    // What this process takes is not there for the others.
    settings.memory_bytes = std::max(memory_limit().bytes - memory_in_use(), 1.0);
    return settings;
  }

  /// Whether there are errors: all are printed together.
  bool report_errors() const {
    if (!diagnostics_.has_errors()) return false;
    std::vector<Diagnostic> errors = diagnostics_.all();
    std::stable_sort(errors.begin(), errors.end(), [](const Diagnostic& a, const Diagnostic& b) {
      return a.where.line < b.where.line;
    });
    for (size_t i = 0; i < std::min(errors.size(), kMostErrors); ++i)
      log_.write(Log::Level::quiet, errors[i].to_string());
    if (errors.size() > kMostErrors) log_.error("and {} more errors", errors.size() - kMostErrors);
    log_.error("{}: nothing is rendered", options_.list);
    return true;
  }

  int render(const QueueSettings& settings) {
    install_signal_handlers();
    JobQueue queue(jobs_, settings);
    bool is_good = true;
    double seconds = 0;
    {
      JobDisplay display(progress_style(options_.progress), jobs_.size(), log_);
      QueueEvents events;
      events.stop_signal = [] { return std::max(0, interrupt_exit_code() - 128); };
      events.wants_snapshots = take_snapshot_request;
      events.finished = [&](size_t job, const JobResult& result) {
        is_good = is_good && result.is_good();
        display.finished(jobs_[job], result);
      };
      events.tick = [&](size_t running) { display.show(running); };
      try {
        queue.run(events);
      } catch (const std::runtime_error& e) {
        log_.error("{}", e.what());
        is_good = false;
      }
      seconds = display.seconds();
    }
    const BatchOutcome outcome{options_.list, jobs_, queue.results(), program_.command_line,
                               seconds};
    if (!options_.quiet) fmt::print("{}{}\n", outcome_table(outcome), outcome_summary(outcome));
    is_good &= write_reports(outcome, reports(), log_);
    if (const int code = interrupt_exit_code()) return code;
    return is_good ? kSuccess : kSceneFailed;
  }

  const BatchOptions& options_;
  Program& program_;
  Log& log_;
  Diagnostics diagnostics_;
  std::vector<Job> jobs_;
};

}  // namespace

void add_batch_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand(
      "batch", "Render many scenes, each in a process of its own, and report on all of them");
  const auto o = std::make_shared<BatchOptions>();
  c->add_option("jobs", o->list,
                "A .csv file with a job in each row, a .jsonl file with an object in each line, or "
                "a folder: all scenes in it and below")
      ->required();
  c->add_option("options", o->for_all, "Behind --: options of duet render for all jobs");
  c->add_option(
       "-o,--output", o->outputs,
       "Images of jobs that do not say it: file, directory or template with {scene} "
       "{folder}, the options of the job, such as {spp}, and for a folder {subfolder}, the way "
       "to the scene; repeatable (default: {scene}.exr here)")
      ->allow_extra_args(false);
  c->add_option("-j,--jobs", o->jobs,
                "Jobs at a time (default: as many as use all threads, by the sizes of the images)");
  c->add_option("-t,--threads", o->threads, "Threads of all jobs together (default: all)");
  c->add_flag("-n,--dry-run", o->dry_run, "Print the command of each job and render nothing");
  c->option_defaults()->group("Reports");
  c->add_option("--report", o->report, "Write a page with a table and small images");
  c->add_option("--junit", o->junit, "Write the outcome as JUnit XML");
  c->add_option("--csv", o->csv, "Write the outcome as CSV");
  c->option_defaults()->group("Messages");
  CLI::Option* quiet = c->add_flag("-q,--quiet", o->quiet, "Errors only");
  c->add_flag("-v,--verbose", o->verbose, "The messages of every job, too")->excludes(quiet);
  c->add_option("--progress", o->progress, "auto, bar or none")
      ->check(CLI::IsMember({"auto", "bar", "none"}));
  c->footer(
      "The first row of the .csv names the columns: scene, output and long options of duet render "
      "without dashes; a semicolon parts the values of those that are repeatable. In .jsonl they "
      "are the keys. Relative scenes are looked for from the folder of the file.\n"
      "Repeat the command to go on: images that are finished and made with the same settings are "
      "kept.\n"
      "Examples:\n"
      "  duet batch jobs.csv              its first row may be scene,spp,integrator\n"
      "  duet batch jobs.jsonl --report report.html --junit junit.xml\n"
      "  duet batch scenes -o 'images/{scene}-{spp}.exr' -- --spp 64 --size 320x240\n"
      "Exit codes: 0 all jobs have their images; 1 a job failed; 2 wrong usage, or something is "
      "wrong with the list, and nothing was rendered; 129, 130 or 143 interrupted by SIGHUP, "
      "Ctrl-C "
      "or SIGTERM, which the processes of the jobs get, too.");
  c->callback([o, &program] { program.exit_code = BatchCommand(*o, program).run(); });
}

}  // namespace duet
