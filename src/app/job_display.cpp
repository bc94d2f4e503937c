#include "app/job_display.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/seconds_text.h"
#include "base/system/standard_streams.h"
#include "evaluate/batch/reports.h"

namespace duet {

JobDisplay::JobDisplay(ProgressStyle style, size_t jobs, Log& log)
    : has_bar_(log.level() != Log::Level::quiet &&
               (style == ProgressStyle::bar ||
                (style == ProgressStyle::automatic && is_terminal(StandardStream::error)))),
      jobs_(jobs),
      log_(log),
      bar_(log) {}

double JobDisplay::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void JobDisplay::finished(const batch::Job& job, const batch::JobResult& result) {
  ++finished_;
  kept_ += result.status == batch::JobStatus::kept;
  bad_ += !result.is_good();
  const std::string details = batch::result_text(result);
  const std::string text =
      fmt::format("[{}/{}] {} {}{}{}", finished_, jobs_, batch::status_name(result.status),
                  batch::job_name(job), details.empty() ? "" : ": ", details);
  if (result.is_good())
    log_.info("{}", text);
  else
    log_.error("{} ({})", text, job.where.to_string());
  for (const std::string& message : result.messages) log_.detail("  {}", message);
}

std::string JobDisplay::bar_line(size_t running) const {
  constexpr size_t kLength = 24;
  const size_t filled = kLength * finished_ / std::max<size_t>(jobs_, 1);
  std::string line = fmt::format("[{}{}] {} of {} jobs, {} running", std::string(filled, '#'),
                                 std::string(kLength - filled, '.'), finished_, jobs_, running);
  if (bad_ > 0) line += fmt::format(", {} failed", bad_);
  // What is kept takes no time that would say something about the others.
  if (const size_t rendered = finished_ - kept_; rendered > 0)
    line += fmt::format(", {} left",
                        seconds_text(seconds() / double(rendered) * double(jobs_ - finished_)));
  return line;
}

void JobDisplay::show(size_t running) {
  if (has_bar_) bar_.draw(bar_line(running));
}

}  // namespace duet
