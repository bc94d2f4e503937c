#include "support/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace duet::test {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Opens a file as one of the standard streams; only async-signal-safe calls.
void redirect(const char* path, int stream) {
  const int how = stream == STDIN_FILENO ? O_RDONLY : O_WRONLY | O_CREAT | O_TRUNC;
  const int file = open(path, how | O_NOCTTY, 0600);
  if (file < 0 || dup2(file, stream) < 0) _exit(127);
}

}  // namespace

const char* program_path() {
  return DUET_PROGRAM;
}

Process::Process(const std::vector<std::string>& arguments, const ProcessOptions& o)
    : start_(now()) {
  std::vector<std::string> texts{program_path()};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& t : texts) argv.push_back(t.data());
  argv.push_back(nullptr);
  const std::string out = o.output.empty() ? streams_.path("out") : o.output;
  const std::string err = o.errors.empty() ? streams_.path("err") : o.errors;
  id_ = fork();
  if (id_ != 0) return;
  if (!o.directory.empty() && chdir(o.directory.c_str()) != 0) _exit(127);
  for (const auto& [name, value] : o.environment) setenv(name.c_str(), value.c_str(), 1);
  if (!o.input.empty()) redirect(o.input.c_str(), STDIN_FILENO);
  redirect(out.c_str(), STDOUT_FILENO);
  redirect(err.c_str(), STDERR_FILENO);
  if (o.file_limit > 0) {
    const rlimit limit{o.file_limit, o.file_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  for (const int signal : o.ignored) std::signal(signal, SIG_IGN);
  for (const int stream : o.closed) close(stream);
  execv(argv[0], argv.data());
  _exit(127);
}

Process::~Process() {
  if (id_ > 0) wait(0);
}

void Process::send(int signal) const {
  kill(id_, signal);
}

bool Process::wait_until(const std::function<bool()>& state, double seconds) {
  for (const double end = now() + seconds; now() < end; pause())
    if (state()) return true;
  return false;
}

bool Process::wait_for_message(const std::string& text, double seconds) const {
  return wait_until([&] { return read_file(streams_.path("err")).find(text) != std::string::npos; },
                    seconds);
}

Outcome Process::wait(double seconds) {
  Outcome result;
  int status = 0;
  const double end = now() + seconds;
  while (waitpid(id_, &status, WNOHANG) == 0) {
    if (now() < end) {
      pause();
      continue;
    }
    kill(id_, SIGKILL);
    waitpid(id_, &status, 0);
    status = -1;
    break;
  }
  id_ = -1;
  result.seconds = now() - start_;
  if (status != -1) result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_file(streams_.path("out"));
  result.err = read_file(streams_.path("err"));
  return result;
}

Outcome run_duet(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  return Process(arguments, options).wait(300);
}

}  // namespace duet::test
