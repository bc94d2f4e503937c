// The subcommands of the program, one file each.
#pragma once

#include <string_view>

#include "base/failures.h"

// CLI11 is large: only files that add options include it.
namespace CLI {
class App;
}

namespace duet {

/// Exit codes of the program.
enum ExitCode : int {
  kSuccess = 0,
  kSceneFailed = 1,
  kWrongUsage = 2,
  kThresholdMissed = 3,
  kTargetMissed = 4,
};

struct ExitStatus {
  std::string_view codes, meaning;
};
/// For `duet --help` and the manual page.
inline constexpr ExitStatus kExitStatus[] = {
    {"0", "all was done, and no threshold missed"},
    {"1", "a scene, a job or a file failed"},
    {"2", "wrong usage: nothing was rendered"},
    {"3", "a threshold was missed: --require, --require-complete, a row of stability"},
    {"4", "--require-target, and the error was not reached"},
    {"129, 130, 143", "interrupted by SIGHUP, SIGINT (Ctrl-C) or SIGTERM"}};

struct Program;

/// Each adds a subcommand to `app`; when it is used, its callback stores the exit code in
/// `program`.
void add_render_command(CLI::App& app, Program& program);
void add_batch_command(CLI::App& app, Program& program);
void add_info_command(CLI::App& app, Program& program);
void add_convert_command(CLI::App& app, Program& program);
void add_merge_command(CLI::App& app, Program& program);
void add_slurm_command(CLI::App& app, Program& program);
void add_compare_command(CLI::App& app, Program& program);
void add_chart_command(CLI::App& app, Program& program);
void add_view_command(CLI::App& app, Program& program);
void add_plugins_command(CLI::App& app, Program& program);
void add_stability_command(CLI::App& app, Program& program);
/// Tells of all commands that were added.
void add_completion_command(CLI::App& app);

}  // namespace duet
