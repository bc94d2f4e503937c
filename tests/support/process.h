// Runs the program the way a user does.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/files.h"

namespace duet::test {

/// What a finished program left behind.
struct Outcome {
  int code = -1;  ///< exit code; 128 + signal if it was killed; −1 if it had to be ended
  std::string out, err;
  double seconds = 0;
};

struct ProcessOptions {
  std::string directory = {};  ///< where it runs
  std::vector<std::pair<std::string, std::string>> environment = {};
  /// Bytes that a file may have, as `ulimit -f` sets them; 0 is no limit.
  size_t file_limit = 0;
  /// The file that is standard input; "" is that of the tests.
  std::string input = {};
  /// Where standard output and standard error go; "" is Outcome::out and Outcome::err.
  std::string output = {}, errors = {};
  /// Standard streams that are closed, by number.
  std::vector<int> closed = {};
  /// Signals that are ignored, as nohup does it; SIGINT, SIGTERM and SIGHUP have their effect
  /// otherwise.
  std::vector<int> ignored = {};
};

/// Of the program `duet` that is tested.
const char* program_path();

/// The program `duet` under way.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const ProcessOptions& options);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const;
  /// Waits until `state` is true; false after `seconds`.
  static bool wait_until(const std::function<bool()>& state, double seconds);
  /// Waits until standard error contains a text; false after `seconds`.
  bool wait_for_message(const std::string& text, double seconds) const;
  /// Waits for the end, and after `seconds` makes it.
  Outcome wait(double seconds);

 private:
  TemporaryDirectory streams_;
  pid_t id_ = -1;
  double start_;
};

/// Runs `duet` with these arguments to the end, which must come within five minutes: seconds are
/// expected, but a machine may stand still for a while, and only what never ends is an error.
Outcome run_duet(const std::vector<std::string>& arguments, const ProcessOptions& options);

}  // namespace duet::test
