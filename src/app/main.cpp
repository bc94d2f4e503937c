// The program: picks the subcommand and turns what went wrong into an exit code.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <string>

#include "app/commands.h"
#include "base/log.h"

namespace duet {

std::string command_line;

namespace {

constexpr std::array<const char*, 3> kCommands{"render", "info", "compare"};

/// `duet SCENE …` is short for `duet render SCENE …`.
bool names_no_command(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return false;
  const std::string& first = arguments[0];
  if (first == "-h" || first == "--help" || first == "--version") return false;
  return std::find(kCommands.begin(), kCommands.end(), first) == kCommands.end();
}

int run(std::vector<std::string> arguments) {
  for (const std::string& a : arguments) command_line += (command_line.empty() ? "duet " : " ") + a;
  if (names_no_command(arguments)) arguments.insert(arguments.begin(), "render");

  CLI::App app{
      "Duet renders the Mitsuba scenes you already have and says how accurate the images are.",
      "duet"};
  app.set_version_flag("--version", "duet " DUET_VERSION);
  app.require_subcommand(1);
  app.footer(
      "duet SCENE... is short for duet render SCENE...\n"
      "Every command has --help with examples.");
  int exit_code = kSuccess;
  add_render_command(app, exit_code);
  add_info_command(app, exit_code);
  add_compare_command(app, exit_code);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help and --version
    log::error("{}", e.what());
    log::error("see duet --help");
    return kWrongUsage;
  } catch (const UsageError& e) {
    log::error("{}", e.what());
    return kWrongUsage;
  } catch (const std::bad_alloc&) {
    log::error("out of memory");
    return kSceneFailed;
  } catch (const std::exception& e) {
    log::error("{}", e.what());
    return kSceneFailed;
  }
  return exit_code;
}

}  // namespace
}  // namespace duet

int main(int argc, char** argv) {
  return duet::run({argv + 1, argv + argc});
}
