// This program, started again as a process of its own.
#pragma once

#include <string>
#include <vector>

namespace duet {

/// How a process ended.
struct ChildEnd {
  int exit_code = 0;     ///< if no signal ended it
  int signal = 0;        ///< that ended it, or 0
  std::string messages;  ///< the beginning of what it wrote to standard error
  bool has_more_messages = false;
};

/// The program itself, started again with other arguments, in a process group of its own, so that
/// keys such as Ctrl-C reach it through its parent alone. Its standard input and output are
/// /dev/null. When its parent ends, it gets SIGTERM.
class ChildProcess {
 public:
  /// `environment` is added to that of this process, as "NAME=VALUE". Throws std::runtime_error if
  /// no process can be started.
  ChildProcess(const std::vector<std::string>& arguments,
               const std::vector<std::string>& environment);
  /// Kills it if it has not ended.
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  void send(int signal) const;
  /// Wishes the image so far, which the process may not hear if it has just been started.
  void ask_for_snapshot() const;
  /// Reads the messages that there are. False if there will be no more: the process has ended or is
  /// about to.
  bool read_messages();
  /// Waits for the end, which comes soon after the last messages.
  ChildEnd end();

 private:
  friend void wait_for_messages(const std::vector<const ChildProcess*>& processes,
                                int milliseconds);

  int id_ = -1;
  int stream_ = -1;
  std::string messages_;
  bool has_more_messages_ = false;
};

/// Waits until one of the processes has messages or ends, a signal comes, or so many milliseconds
/// have passed.
void wait_for_messages(const std::vector<const ChildProcess*>& processes, int milliseconds);

}  // namespace duet
