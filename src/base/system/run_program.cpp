#include "base/system/run_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

namespace duet {

namespace {

constexpr size_t kMostKept = size_t(1) << 20;

[[noreturn]] void fail_to_run(const std::string& program, int error) {
  throw std::runtime_error(fmt::format("cannot run {}: {}", program, std::strerror(error)));
}

/// Both ends are closed when the pipe goes away.
class Pipe {
 public:
  explicit Pipe(const std::string& program) {
    if (pipe2(ends_, O_CLOEXEC) != 0) fail_to_run(program, errno);
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_end(int end) {
    if (ends_[end] >= 0) close(std::exchange(ends_[end], -1));
  }

 private:
  int ends_[2] = {-1, -1};
};

pid_t spawn(const std::vector<std::string>& arguments, const Pipe& out, const Pipe& err) {
  std::vector<std::string> texts = arguments;
  std::vector<char*> argv;
  for (std::string& t : texts) argv.push_back(t.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.write_end(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write_end(), STDERR_FILENO);
  pid_t id = -1;
  const int error = posix_spawnp(&id, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail_to_run(arguments[0], error);
  return id;
}

/// Reads both streams to their ends.
void read_streams(Pipe& out, Pipe& err, ProgramEnd& end) {
  Pipe* const pipes[] = {&out, &err};
  std::string* const texts[] = {&end.out, &end.err};
  while (out.read_end() >= 0 || err.read_end() >= 0) {
    pollfd streams[] = {{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}};
    if (poll(streams, 2, -1) < 0 && errno != EINTR) return;
    for (int i = 0; i < 2; ++i) {
      if (streams[i].revents == 0) continue;
      char block[4096];
      const ssize_t n = read(streams[i].fd, block, sizeof block);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) pipes[i]->close_end(0);
      if (n > 0) texts[i]->append(block, std::min(size_t(n), kMostKept - texts[i]->size()));
    }
  }
}

}  // namespace

std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view folders = path ? path : "";
  while (!folders.empty()) {
    const size_t end = std::min(folders.find(':'), folders.size());
    const std::filesystem::path file = std::filesystem::path(folders.substr(0, end)) / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0)
      return file.string();
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return "";
}

ProgramEnd run_program(const std::vector<std::string>& arguments) {
  Pipe out(arguments.at(0)), err(arguments[0]);
  const pid_t id = spawn(arguments, out, err);
  out.close_end(1);
  err.close_end(1);
  ProgramEnd end;
  read_streams(out, err, end);
  int status = 0;
  while (waitpid(id, &status, 0) < 0)
    if (errno != EINTR) fail_to_run(arguments[0], errno);
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return end;
}

CommandEnd run_timed(const std::string& command, double limit, const std::atomic<bool>& cancel) {
  using Clock = std::chrono::steady_clock;
  CommandEnd end;
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child < 0) return end;
  if (child == 0) {
    setpgid(0, 0);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    for (const int s : {SIGINT, SIGTERM, SIGXFSZ, SIGPIPE}) std::signal(s, SIG_DFL);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  setpgid(child, child);
  end.started = true;
  int status = 0;
  rusage usage{};
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    if (!end.stopped && (cancel.load() || elapsed() > limit)) {
      end.stopped = true;
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  end.seconds = elapsed();
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  end.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return end;
}

}  // namespace duet
