// A process of this program that renders a job.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace duet::batch {

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

  /// Becomes readable when there are messages, and when the process ends.
  int stream() const { return stream_; }
  pid_t id() const { return id_; }
  void send(int signal) const;
  /// Reads the messages that there are. False if there will be no more: the process has ended or is
  /// about to.
  bool read_messages();
  /// Waits for the end, which comes soon after the last messages.
  ChildEnd end();

 private:
  pid_t id_ = -1;
  int stream_ = -1;
  std::string messages_;
  bool has_more_messages_ = false;
};

}  // namespace duet::batch
