// Renders the jobs of a batch: each in a process of its own, as many at a time as the machine has
// threads and memory for.
#pragma once

#include <deque>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "base/system/child_process.h"
#include "evaluate/batch/job.h"
#include "evaluate/batch/job_result.h"

namespace duet::batch {

struct QueueSettings {
  int threads = 1;          ///< of all processes together
  int jobs_at_once = 0;     ///< 0: as follows from the sizes of the images
  double memory_bytes = 0;  ///< of all processes together; may be infinite
};

/// What the queue asks and tells whoever runs it.
struct QueueEvents {
  /// The signal that asks to stop, or 0. The processes get it, too, and no others are started.
  std::function<int()> stop_signal;
  /// Whether someone wishes the images so far; the processes are told.
  std::function<bool()> wants_snapshots;
  /// A job has come to its end.
  std::function<void(size_t job, const JobResult& result)> finished;
  /// Several times a second.
  std::function<void(size_t running)> tick;
};

/// Threads: an image gets one for every kPixelsPerThread of its pixels, or more if there are fewer
/// jobs than threads. Jobs are started in their order, but small ones go on while a large one waits
/// for the threads that it is to have.
///
/// Memory: each process may take the share of the limit that its threads are of all threads, and
/// refuses its job if that needs more (memory_refusal). A job that fails for lack of memory beside
/// others is rendered again in the end, alone and with all of the limit.
class JobQueue {
 public:
  static constexpr double kPixelsPerThread = 16384;

  JobQueue(const std::vector<Job>& jobs, const QueueSettings& settings);

  /// Returns when all jobs have come to an end, or those that are under way after a signal. Throws
  /// std::runtime_error if no process can be started or there is no room for temporary files; the
  /// results so far stay.
  void run(const QueueEvents& events);
  /// One for each job.
  const std::vector<JobResult>& results() const { return results_; }

 private:
  /// With the threads that it is to have.
  struct Planned {
    size_t job;
    int threads;
  };
  struct Running {
    size_t job;
    int threads;
    bool has_share;  ///< of the memory: not all of it
    double start, killed_before;
    std::string statistics_file;
    ChildProcess process;
  };

  int wanted_threads(size_t job) const;
  int free_threads() const;
  /// The next job that may start now, with the threads that there are for it.
  std::optional<Planned> choose();
  void start(const Planned& planned, bool alone);
  void start_what_fits();
  /// A signal ends it early.
  void wait();
  void finish(Running& running, const QueueEvents& events);

  const std::vector<Job>& jobs_;
  QueueSettings settings_;
  std::vector<JobResult> results_;
  size_t next_ = 0;  ///< the first that has not been looked at
  size_t unfinished_;
  std::deque<Planned> waiting_;  ///< looked at and not started
  std::deque<size_t> alone_;     ///< for which there was too little memory beside others
  std::list<Running> running_;
  std::string folder_;  ///< for statistics
};

}  // namespace duet::batch
