// The command line of `duet render` without what the command does.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "app/render_options.h"

namespace duet {

struct RenderGrammar {
  explicit RenderGrammar(Program& program) : parser(command, program) {}
  /// Throws CLI::ParseError.
  void parse(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    command.parse(arguments);
  }

  CLI::App command;
  RenderOptionParser parser;
};

}  // namespace duet
