#include "base/system/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/system/process.h"

namespace duet {

namespace {

/// Of the messages of a process so much is kept.
constexpr size_t kMostMessageBytes = 16384;

/// What starts this program again. Through /proc that is the file that is running, even where
/// another one has taken its name since.
std::string program_file() {
  constexpr const char* kRunning = "/proc/self/exe";
  return access(kRunning, X_OK) == 0 ? kRunning : own_program();
}

/// What a new process becomes.
struct Program {
  const char* file;
  char *const *arguments, *const *environment;
};

/// The texts as exec() wants them.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Keeps signals waiting while it exists. One that comes between fork() and exec() would otherwise
/// be handled by a copy of the parent, and be lost.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsWait() { end(); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
  void end() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

/// Lets the signals that the parent handles have their effect; what is ignored stays ignored.
void handle_no_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN)
      ::signal(signal, SIG_DFL);
  }
  // A wish for the image so far, which must not end a process that does not listen yet.
  ::signal(SIGUSR1, SIG_IGN);
}

/// What the new process does before it becomes the program; only async-signal-safe calls.
[[noreturn]] void become(const Program& program, int stream, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
  const int nothing = open("/dev/null", O_RDWR);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(nothing, STDOUT_FILENO) < 0 ||
      dup2(stream, STDERR_FILENO) < 0)
    _exit(127);
  if (nothing > STDERR_FILENO) close(nothing);
  execve(program.file, program.arguments, program.environment);
  constexpr char text[] = "duet: error: the program cannot be started again\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment) {
  std::vector<std::string> texts{"duet"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment;
  // The first of two with one name counts.
  for (char** variable = environ; *variable; ++variable) variables.emplace_back(*variable);
  const std::string file = program_file();
  const std::vector<char*> argv = pointers(texts), envp = pointers(variables);
  const auto fail = [] {
    throw std::runtime_error(fmt::format("no process can be started: {}", std::strerror(errno)));
  };
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail();
  const pid_t parent = getpid();
  const SignalsWait signals;
  id_ = fork();
  if (id_ == 0) {
    handle_no_signals();
    signals.end();
    become({file.c_str(), argv.data(), envp.data()}, ends[1], parent);
  }
  close(ends[1]);
  stream_ = ends[0];
  if (id_ < 0) {
    close(stream_);
    fail();
  }
  // Here, too, so that it holds whoever comes first.
  setpgid(id_, id_);
  fcntl(stream_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  if (id_ > 0) {
    kill(id_, SIGKILL);
    end();
  }
  if (stream_ >= 0) close(stream_);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      stream_(std::exchange(other.stream_, -1)),
      messages_(std::move(other.messages_)),
      has_more_messages_(other.has_more_messages_) {}

void ChildProcess::send(int signal) const {
  if (id_ > 0) kill(id_, signal);
}

void ChildProcess::ask_for_snapshot() const {
  send(SIGUSR1);
}

bool ChildProcess::read_messages() {
  char block[4096];
  while (true) {
    const ssize_t n = read(stream_, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    if (n == 0) return false;
    const size_t room = kMostMessageBytes - messages_.size();
    messages_.append(block, std::min(size_t(n), room));
    has_more_messages_ |= size_t(n) > room;
  }
}

ChildEnd ChildProcess::end() {
  int status = 0;
  while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  ChildEnd end;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.messages = std::move(messages_);
  end.has_more_messages = has_more_messages_;
  return end;
}

void wait_for_messages(const std::vector<const ChildProcess*>& processes, int milliseconds) {
  std::vector<pollfd> streams;
  for (const ChildProcess* process : processes) streams.push_back({process->stream_, POLLIN, 0});
  poll(streams.data(), streams.size(), milliseconds);
}

}  // namespace duet
