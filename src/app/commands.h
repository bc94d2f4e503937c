// The subcommands of the program, one file each.
#pragma once

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
