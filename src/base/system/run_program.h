// Other programs, run to their end or until their time is up.
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace duet {

/// How a program ended, and what it said.
struct ProgramEnd {
  int exit_code = 0;  ///< 128 + signal if a signal ended it
  std::string out, err;
};

/// The file of a program that PATH leads to, or "".
std::string find_program(const std::string& name);

/// Runs a program, the first of the arguments, with no standard input. Of each of its streams the
/// first megabyte is kept. Throws std::runtime_error if it cannot be started.
ProgramEnd run_program(const std::vector<std::string>& arguments);

/// What became of a command.
struct CommandEnd {
  bool started = false, stopped = false;
  int exit_code = 0;  ///< if no signal ended it
  int signal = 0;     ///< that ended it, or 0
  double seconds = 0, cpu_seconds = 0;
};

/// Runs a command of the shell in a process group of its own, what it prints going to standard
/// error, and ends the whole group after `limit` seconds or when `cancel` is set.
CommandEnd run_timed(const std::string& command, double limit, const std::atomic<bool>& cancel);

}  // namespace duet
