// The program: picks the subcommand and turns what went wrong into an exit code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "app/commands.h"
#include "app/environment.h"
#include "app/help.h"
#include "app/program.h"
#include "base/diagnostics.h"
#include "base/shell.h"
#include "base/system/signals.h"
#include "base/system/standard_streams.h"
#include "evaluate/report/provenance.h"
#include "evaluate/report/version.h"

namespace duet {

namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(c->get_name());
  return names;
}

/// `duet help COMMAND` is `duet COMMAND --help`.
std::vector<std::string> help_arguments(const std::vector<std::string>& arguments,
                                        const CLI::App& app) {
  if (arguments.size() == 1) return {"--help"};
  const std::vector<std::string> names = command_names(app);
  if (std::find(names.begin(), names.end(), arguments[1]) == names.end())
    throw UsageError(fmt::format("there is no command \"{}\"{}", arguments[1],
                                 did_you_mean(arguments[1], names)));
  return {arguments[1], "--help"};
}

/// What is short for something is written out: `duet SCENE …` for `duet render SCENE …`. Throws
/// UsageError for what looks like a misspelt command.
std::vector<std::string> in_full(std::vector<std::string> arguments, const CLI::App& app) {
  if (arguments.empty()) return arguments;
  const std::string& first = arguments[0];
  if (first == "help") return help_arguments(arguments, app);
  if (first == "-h" || first == "--help" || first == "--version") return arguments;
  std::vector<std::string> names = command_names(app);
  if (std::find(names.begin(), names.end(), first) != names.end()) return arguments;
  names.emplace_back("help");
  std::error_code ignored;
  const std::string hint = did_you_mean(first, names);
  if (!hint.empty() && !std::filesystem::exists(first, ignored))
    throw UsageError(fmt::format("there is no command and no scene \"{}\"{}", first, hint));
  arguments.insert(arguments.begin(), "render");
  return arguments;
}

/// An option without a value is a mistake, often of a script whose variable is empty. CLI11 would
/// take the next argument for the value of "--option=".
void refuse_cut_options(const std::vector<std::string>& arguments) {
  for (const std::string& a : arguments) {
    if (a == "--") return;
    if (a.size() > 2 && a.starts_with("--") && a.find('=') == a.size() - 1)
      throw UsageError(fmt::format("{} has no value", a));
  }
}

/// The same of values that are there and empty.
void refuse_empty_values(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    for (CLI::Option* option : command->get_options())
      if (option->get_type_size() > 0 && option->nonpositional())
        option->check([](const std::string& value) {
          return value.empty() ? std::string("the value is empty") : std::string();
        });
}

/// A line for each thing that the program is made of.
std::string version_text() {
  std::vector<Version> all = versions();
  all.emplace_back("CLI11", CLI11_VERSION);
  std::string text;
  for (const auto& [name, version] : all)
    text += fmt::format("{}{:<14}{}", text.empty() ? "" : "\n", name, version);
  return text;
}

/// Results that did not arrive are a failure.
int after_output(Program& program, int exit_code) {
  std::cout.flush();
  if (std::cout.good() && std::fflush(stdout) == 0 && !std::ferror(stdout)) return exit_code;
  program.log.error("cannot write to standard output");
  return exit_code == kSuccess ? int(kSceneFailed) : exit_code;
}

std::string footer() {
  std::string text =
      "duet SCENE... is short for duet render SCENE...\n"
      "duet help COMMAND, or duet COMMAND --help, has its options and examples.\n\n"
      "Environment:";
  for (const auto& [name, what] : kEnvironment) text += fmt::format("\n  {:<19} {}", name, what);
  text += "\n\nExit codes:";
  for (const auto& [codes, meaning] : kExitStatus)
    text += fmt::format("\n  {:<19} {}", codes, meaning);
  return text;
}

int run(std::vector<std::string> arguments, Program& program) {
  program.command_line = "duet " + shell_quoted(host_free(arguments));
  CLI::App app{
      "Duet renders the Mitsuba scenes you already have and says how accurate the images are.",
      "duet"};
  app.set_version_flag(
      "--version",
      [&app] { return app.count("--verbose") > 0 ? version_text() : "duet " DUET_VERSION; },
      "Print the version and exit; with -v that of all libraries, too");
  app.add_flag("-v,--verbose")->group("");
  app.require_subcommand(1);
  app.footer(footer());
  app.formatter(std::make_shared<HelpFormatter>());
  add_render_command(app, program);
  add_batch_command(app, program);
  add_info_command(app, program);
  add_convert_command(app, program);
  add_merge_command(app, program);
  add_slurm_command(app, program);
  add_compare_command(app, program);
  add_chart_command(app, program);
  add_view_command(app, program);
  add_plugins_command(app, program);
  add_stability_command(app, program);
  add_completion_command(app);
  refuse_empty_values(app);
  try {
    arguments = in_full(std::move(arguments), app);
    refuse_cut_options(arguments);
    const std::string help = arguments.empty() ? "duet --help" : "duet " + arguments[0] + " --help";
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
      app.parse(arguments);
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() == 0)
        return after_output(program, app.exit(e));  // --help and --version
      throw UsageError(fmt::format("{}; see {}", e.what(), help));
    }
  } catch (const UsageError& e) {
    program.log.error("{}", e.what());
    return kWrongUsage;
  } catch (const std::bad_alloc&) {
    program.log.error("out of memory");
    return kSceneFailed;
  } catch (const std::exception& e) {
    program.log.error("{}", e.what());
    return kSceneFailed;
  }
  return after_output(program, program.exit_code);
}

}  // namespace
}  // namespace duet

int main(int argc, char** argv) {
  duet::open_standard_streams();
  duet::let_large_files_fail();
  try {
    duet::Program program;
    return duet::run({argv + 1, argv + argc}, program);
  } catch (...) {
    // What went wrong where even a message fails.
    std::fputs("duet: error: out of memory\n", stderr);
    return duet::kSceneFailed;
  }
}
