// Other programs, run to their end.
#pragma once

#include <string>
#include <vector>

namespace duet {

/// How a program ended, and what it said.
struct ProgramEnd {
  int exit_code = 0;  ///< 128 + signal if a signal ended it
  std::string out, err;
};

/// The file of the program that is running, or "" if that cannot be found out.
std::string own_program();

/// The file of a program that PATH leads to, or "".
std::string find_program(const std::string& name);

/// Runs a program, the first of the arguments, with no standard input. Of each of its streams the
/// first megabyte is kept. Throws std::runtime_error if it cannot be started.
ProgramEnd run_program(const std::vector<std::string>& arguments);

}  // namespace duet
