// Another renderer as a child process: started, timed, and stopped when its time is up.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "evaluate/chart/renderers.h"
#include "evaluate/compare/linear_image.h"
#include "evaluate/render/placeholders.h"

namespace duet {

namespace {

using Clock = std::chrono::steady_clock;

/// What became of a command.
struct Run {
  bool started = false, stopped = false;
  int status = 0;
  double seconds = 0, cpu_seconds = 0;
};

/// Runs a command in a process group of its own, what it prints going to standard error, and ends
/// the whole group after `limit` seconds or when `cancel` is set.
Run run(const std::string& command, double limit, const std::atomic<bool>& cancel) {
  Run r;
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child < 0) return r;
  if (child == 0) {
    setpgid(0, 0);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    for (const int s : {SIGINT, SIGTERM, SIGXFSZ, SIGPIPE}) signal(s, SIG_DFL);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  setpgid(child, child);
  r.started = true;
  rusage usage{};
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  while (wait4(child, &r.status, WNOHANG, &usage) == 0) {
    if (!r.stopped && (cancel.load() || elapsed() > limit)) {
      r.stopped = true;
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  r.seconds = elapsed();
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  r.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return r;
}

/// A file that is there neither before nor after, whatever a renderer does and whenever it is
/// stopped.
struct RemovedFile {
  const std::string path;
  explicit RemovedFile(std::string file) : path(std::move(file)) { remove(); }
  ~RemovedFile() { remove(); }
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

}  // namespace

bool ExternalRenderer::finished() const {
  // The next run takes about twice as long as the last one.
  return !line.failure.empty() || used_ + 2 * last_ > budget_;
}

void ExternalRenderer::fail(const std::string& why) {
  line.failure = fmt::format("at {} spp: {}", task_.run.spp, why);
}

void ExternalRenderer::slice(double) {
  const RemovedFile output{task_.run.output};
  ExternalRun& next = task_.run;
  const Run r = run(task_.command(next), budget_ - used_, *task_.cancel);
  used_ += r.seconds;
  last_ = r.seconds;
  if (task_.cancel->load()) return;
  if (!r.started) return fail("it cannot be started");
  if (r.stopped) {
    // A run that was expected to fit and did not is no failure if there are others before it.
    used_ = budget_;
    if (line.points.empty()) fail("it did not end within its share of the time");
    return;
  }
  if (WIFSIGNALED(r.status))
    return fail(fmt::format("it was ended by signal {}", WTERMSIG(r.status)));
  if (WEXITSTATUS(r.status) != 0)
    return fail(fmt::format("it ended with exit code {}", WEXITSTATUS(r.status)));
  try {
    LinearImage image = load_linear(next.output);
    record(r.seconds, r.cpu_seconds, next.spp, std::move(image.image));
  } catch (const std::exception& e) {
    return fail(e.what());
  }
  next.spp *= 2;
}

ExternalCommand external_command(const std::string& pattern) {
  return [pattern](const ExternalRun& run) {
    return fill_in("--external", pattern,
                   {{"spp", fmt::to_string(run.spp)},
                    {"out", run.output},
                    {"scene", run.scene},
                    {"seed", fmt::to_string(run.seed)},
                    {"width", fmt::to_string(run.width)},
                    {"height", fmt::to_string(run.height)}});
  };
}

}  // namespace duet
