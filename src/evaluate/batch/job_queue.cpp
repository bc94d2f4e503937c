#include "evaluate/batch/job_queue.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/memory_limit.h"
#include "evaluate/batch/image_pixels.h"
#include "evaluate/batch/job_arguments.h"
#include "evaluate/batch/temporary_folder.h"

namespace duet::batch {

namespace {

/// How long at most a signal waits to be noticed.
constexpr int kTickMilliseconds = 100;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

JobQueue::JobQueue(const std::vector<Job>& jobs, const QueueSettings& settings)
    : jobs_(jobs), settings_(settings), results_(jobs.size()), unfinished_(jobs.size()) {}

int JobQueue::free_threads() const {
  int used = 0;
  for (const Running& r : running_) used += r.threads;
  return settings_.threads - used;
}

int JobQueue::wanted_threads(size_t job) const {
  const int all = settings_.threads;
  int own = 0;
  const std::string text = jobs_[job].value("threads");
  std::from_chars(text.data(), text.data() + text.size(), own);
  if (own > 0) return std::min(own, all);
  if (settings_.jobs_at_once > 0)
    return std::max(1, all / std::min(settings_.jobs_at_once, int(unfinished_)));
  // A scene that cannot be read will not take long.
  const double by_pixels = image_pixels(jobs_[job]).value_or(0) / kPixelsPerThread;
  const double by_jobs = double(all) / double(unfinished_);
  return int(std::clamp(std::max(by_pixels, by_jobs), 1.0, double(all)));
}

std::optional<JobQueue::Planned> JobQueue::choose() {
  // With a given number of jobs their threads do not matter.
  const bool is_fixed = settings_.jobs_at_once > 0;
  if (is_fixed && int(running_.size()) >= settings_.jobs_at_once) return std::nullopt;
  const int free = free_threads();
  if (!is_fixed && free <= 0) return std::nullopt;
  const size_t most_waiting = 2 * size_t(settings_.threads);
  for (size_t i = 0;; ++i) {
    if (i == waiting_.size()) {
      if (next_ == jobs_.size() || waiting_.size() >= most_waiting) return std::nullopt;
      waiting_.push_back({next_, wanted_threads(next_)});
      ++next_;
    }
    Planned planned = waiting_[i];
    // More than half of them now are better than all of them later.
    if (!is_fixed && planned.threads > free && planned.threads >= 2 * free) continue;
    if (!is_fixed) planned.threads = std::min(planned.threads, free);
    waiting_.erase(waiting_.begin() + std::ptrdiff_t(i));
    return planned;
  }
}

void JobQueue::start(const Planned& planned, bool alone) {
  const auto [job, threads] = planned;
  const double parts = settings_.jobs_at_once > 0 ? double(settings_.jobs_at_once)
                                                  : double(settings_.threads) / double(threads);
  const bool has_share = !alone && parts > 1;
  std::vector<std::string> environment;
  if (std::isfinite(settings_.memory_bytes))
    environment.push_back(fmt::format("{}={:.0f}", kMemoryLimitVariable,
                                      settings_.memory_bytes / (has_share ? parts : 1)));
  const std::string statistics = fmt::format("{}/{}.json", folder_, job);
  running_.push_back(
      {job, threads, has_share, seconds_now(), processes_out_of_memory(), statistics,
       ChildProcess(render_arguments(jobs_[job], threads, statistics), environment)});
}

void JobQueue::start_what_fits() {
  while (const std::optional<Planned> next = choose()) try {
      start(*next, false);
    } catch (const std::runtime_error&) {
      // The system may have room for another process when one of these has ended.
      if (running_.empty()) throw;
      waiting_.push_front(*next);
      return;
    }
  if (!running_.empty() || alone_.empty()) return;
  const size_t job = alone_.front();
  alone_.pop_front();
  start({job, settings_.threads}, true);
}

void JobQueue::wait() {
  std::vector<const ChildProcess*> processes;
  for (const Running& r : running_) processes.push_back(&r.process);
  wait_for_messages(processes, kTickMilliseconds);
}

void JobQueue::finish(Running& r, const QueueEvents& events) {
  const ChildEnd end = r.process.end();
  JobResult result = result_of(jobs_[r.job], end, r.statistics_file);
  std::error_code ignored;
  std::filesystem::remove(r.statistics_file, ignored);
  if (r.has_share && lacks_memory(end, processes_out_of_memory() > r.killed_before)) {
    alone_.push_back(r.job);
    return;
  }
  result.threads = r.threads;
  result.seconds = seconds_now() - r.start;
  results_[r.job] = std::move(result);
  --unfinished_;
  events.finished(r.job, results_[r.job]);
}

void JobQueue::run(const QueueEvents& events) {
  const TemporaryFolder folder;
  folder_ = folder.path();
  int signal = 0;
  while (true) {
    if (const int asked = events.stop_signal(); asked != 0 && signal == 0) {
      signal = asked;
      for (const Running& r : running_) r.process.send(signal);
    }
    if (events.wants_snapshots())
      for (const Running& r : running_) r.process.ask_for_snapshot();
    if (signal == 0) start_what_fits();
    if (running_.empty()) return;
    wait();
    for (auto r = running_.begin(); r != running_.end();) {
      if (r->process.read_messages()) {
        ++r;
        continue;
      }
      finish(*r, events);
      r = running_.erase(r);
    }
    events.tick(running_.size());
  }
}

}  // namespace duet::batch
