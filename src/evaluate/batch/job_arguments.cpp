#include "evaluate/batch/job_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "evaluate/render/placeholders.h"

namespace duet::batch {

bool is_given_by_batch(const std::string& option) {
  static constexpr const char* given[] = {"stats", "progress",      "quiet",      "verbose",
                                          "log",   "skip-existing", "keep-going", "no-keep-going"};
  return std::find(std::begin(given), std::end(given), option) != std::end(given);
}

std::vector<std::string> option_arguments(const Job& job) {
  std::vector<std::string> arguments;
  for (const JobOption& option : job.options) {
    if (option.values.empty()) arguments.push_back("--" + option.name);
    for (const std::string& value : option.values)
      arguments.push_back(fmt::format("--{}={}", option.name, value));
  }
  return arguments;
}

std::vector<std::string> job_arguments(const Job& job) {
  std::vector<std::string> arguments{"render"};
  for (const std::string& output : job.outputs)
    arguments.push_back("--output=" + as_pattern(output));
  for (std::string& option : option_arguments(job)) arguments.push_back(std::move(option));
  // Whatever it begins with, it is no option.
  arguments.insert(arguments.end(), {"--", job.scene});
  return arguments;
}

std::vector<std::string> render_arguments(const Job& job, int threads,
                                          const std::string& statistics_file) {
  std::vector<std::string> arguments = job_arguments(job);
  std::erase_if(arguments, [](const std::string& a) { return a.starts_with("--threads="); });
  // A job that is interrupted goes on when the batch does.
  if (!job.find("checkpoint")) arguments.insert(arguments.begin() + 1, "--checkpoint=60s");
  arguments.insert(arguments.begin() + 1,
                   {"--skip-existing", "--quiet", "--progress=none",
                    fmt::format("--threads={}", threads), "--stats=" + statistics_file});
  return arguments;
}

}  // namespace duet::batch
