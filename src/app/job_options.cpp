#include "app/job_options.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "app/commands.h"
#include "app/program.h"
#include "app/render_grammar.h"
#include "base/readable.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/batch/job_outputs.h"
#include "evaluate/batch/manifest.h"
#include "evaluate/batch/scene_folder.h"
#include "evaluate/render/scene_operand.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

batch::OptionKind option_kind(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return batch::OptionKind::flag;
  if (option.get_items_expected_min() == 0) return batch::OptionKind::optional_value;
  return option.get_items_expected_max() > 1 ? batch::OptionKind::repeatable
                                             : batch::OptionKind::single;
}

/// The long name of an option that jobs can have; "" of all others.
std::string job_option_name(const CLI::Option& option) {
  if (option.get_lnames().empty()) return "";
  const std::string& name = option.get_lnames()[0];
  return name == "help" || name == "output" || batch::is_given_by_batch(name) ? "" : name;
}

/// Takes the option with which a message begins from a job; false if there is none.
bool drop_option(batch::Job& job, const std::string& message) {
  return std::erase_if(job.options, [&](const batch::JobOption& option) {
           return message.starts_with("--" + option.name + ":");
         }) > 0;
}

/// Why `duet render` would refuse the options of a job.
std::vector<std::string> refused_options(batch::Job job, Program& program) {
  std::vector<std::string> reasons;
  while (true) try {
      std::vector<std::string> arguments = batch::job_arguments(job);
      arguments.erase(arguments.begin());  // the command
      RenderGrammar render(program);
      render.parse(std::move(arguments));
      render.parser.finish();
      return reasons;
    } catch (const CLI::ParseError& e) {
      // The parser stops here; what it says of the other options is found without this one.
      reasons.emplace_back(e.what());
      if (!drop_option(job, e.what())) return reasons;
    } catch (const UsageError& e) {
      reasons.insert(reasons.end(), e.mistakes().begin(), e.mistakes().end());
      return reasons;
    }
}

/// The options that jobs can have.
std::vector<batch::RenderOption> job_option_names(Program& program) {
  const RenderGrammar render(program);
  std::vector<batch::RenderOption> options;
  for (const CLI::Option* option : render.command.get_options())
    if (const std::string name = job_option_name(*option); !name.empty())
      options.push_back({name, option_kind(*option)});
  return options;
}

/// The options of `duet render` in arguments that are for all jobs. Throws UsageError.
std::vector<batch::JobOption> options_for_all(const std::vector<std::string>& arguments,
                                              Program& program) {
  RenderGrammar render(program);
  CLI::Option* scene = render.command.get_option("scene");
  scene->required(false);
  try {
    render.parse(arguments);
  } catch (const CLI::ParseError& e) {
    throw UsageError(fmt::format("options of duet render for all jobs: {}", e.what()));
  }
  if (scene->count() > 0)
    throw UsageError(fmt::format("\"{}\" is no option of duet render", scene->results()[0]));
  std::vector<batch::JobOption> options;
  for (const CLI::Option* option : render.command.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = job_option_name(*option);
    if (name.empty())
      throw UsageError(fmt::format("{}: duet batch gives this option of duet render itself",
                                   option->get_name()));
    std::vector<std::string> values = option->results();
    if (option_kind(*option) == batch::OptionKind::flag) values.clear();
    std::erase(values, "");
    options.push_back({name, std::move(values)});
  }
  return options;
}

/// Errors for jobs that `duet render` would refuse before it reads the scene.
void check_jobs(const std::vector<batch::Job>& jobs, Program& program, Diagnostics& diagnostics) {
  for (const batch::Job& job : jobs) {
    if (const std::string why = no_scene_reason(job.scene, ""); !why.empty())
      diagnostics.error(job.where, "cannot read {}: {}", job.scene, why);
    const std::string film = job.value("resume");
    if (const std::string why = film.empty() ? "" : unreadable_reason(film); !why.empty())
      diagnostics.error(job.where, "--resume: cannot read {}: {}", film, why);
    for (const std::string& why : refused_options(job, program))
      diagnostics.error(job.where, "{}", why);
  }
}

}  // namespace

std::vector<batch::Job> list_jobs(const std::string& list, const std::vector<std::string>& for_all,
                                  const std::vector<std::string>& templates, Program& program,
                                  Diagnostics& diagnostics) {
  const std::vector<batch::RenderOption> known = job_option_names(program);
  const std::vector<batch::JobOption> options = options_for_all(for_all, program);
  std::error_code ignored;
  const bool is_folder = fs::is_directory(list, ignored);
  std::vector<batch::Job> jobs = is_folder ? batch::scenes_below(list, diagnostics)
                                           : batch::read_manifest(list, known, diagnostics);
  for (batch::Job& job : jobs) job.scene = scene_file_of(job.scene);
  // Jobs without a scene have been reported, and nothing more can be said about them.
  std::erase_if(jobs, [](const batch::Job& job) { return job.scene.empty(); });
  add_to_all(jobs, options, known);
  batch::name_outputs(jobs, templates, is_folder ? list : "", diagnostics);
  check_outputs_differ(jobs, diagnostics);
  check_jobs(jobs, program, diagnostics);
  return jobs;
}

}  // namespace duet
