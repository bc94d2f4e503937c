// Shows how far a batch has come.
#pragma once

#include <chrono>
#include <string>

#include "app/progress.h"
#include "app/terminal_bar.h"
#include "base/log.h"
#include "evaluate/batch/job.h"
#include "evaluate/batch/job_result.h"

namespace duet {

/// A line for each job that has come to its end and, on a terminal, a bar, both on standard error.
class JobDisplay {
 public:
  /// The log must outlive this.
  JobDisplay(ProgressStyle style, size_t jobs, Log& log);

  void finished(const batch::Job& job, const batch::JobResult& result);
  /// `running` are the processes under way.
  void show(size_t running);

  double seconds() const;

 private:
  std::string bar_line(size_t running) const;

  bool has_bar_;
  size_t jobs_, finished_ = 0, kept_ = 0, bad_ = 0;
  Log& log_;
  TerminalBar bar_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace duet
