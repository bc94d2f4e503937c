#include "evaluate/slurm/sbatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/failures.h"
#include "evaluate/slurm/scripts.h"

namespace duet::slurm {

namespace {

/// Slurm may send the signal to stop a minute earlier than asked for; some time has to be left.
constexpr double kLeastSeconds = kSecondsToStop + 120;

/// Whole numbers between colons; empty if there is anything else.
std::vector<double> numbers_between_colons(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    uint32_t number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return {};
    numbers.push_back(number);
    text.remove_prefix(size_t(rest - text.data()));
    if (text.empty()) return numbers;
    if (text[0] != ':') return {};
    text.remove_prefix(1);
  }
}

}  // namespace

std::optional<double> time_limit(const std::string& text) {
  std::string word = text;
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  const double no_limit = std::numeric_limits<double>::infinity();
  if (word == "infinite" || word == "unlimited") return no_limit;
  const size_t dash = text.find('-');
  const bool has_days = dash != std::string::npos;
  std::vector<double> n = numbers_between_colons(has_days ? text.substr(dash + 1) : text);
  if (n.empty() || n.size() > 3) return std::nullopt;
  double days = 0;
  if (has_days) {
    const std::vector<double> before = numbers_between_colons(text.substr(0, dash));
    if (before.size() != 1) return std::nullopt;
    days = before[0];
  } else if (n.size() < 3) {
    n.insert(n.begin(), 0);  // it begins with minutes
  }
  n.resize(3);
  const double seconds = ((days * 24 + n[0]) * 60 + n[1]) * 60 + n[2];
  return seconds > 0 ? seconds : no_limit;
}

std::string option_refusal(const std::string& line) {
  if (!line.starts_with('-')) return "an option of sbatch begins with a dash";
  if (line.find('\n') != std::string::npos) return "it has several lines";
  std::istringstream words(line);
  for (std::string word; words >> word;)
    for (const char* own : {"--array", "--dependency", "--wrap", "-a", "-d"})
      if (word == own || (word.starts_with(own) && (word[1] != '-' || word.find('=') != word.npos)))
        return fmt::format("{} is what `duet slurm` itself gives", own);
  return "";
}

std::vector<std::string> sbatch_options(const std::string& time, const std::string& partition,
                                        const std::vector<std::string>& others) {
  std::vector<std::string> options;
  if (!time.empty()) {
    const auto seconds = time_limit(time);
    if (!seconds)
      throw UsageError(fmt::format(
          "--time: \"{}\" is no time limit of Slurm, which is MINUTES, HOURS:MINUTES:SECONDS or "
          "DAYS-HOURS",
          time));
    if (*seconds < kLeastSeconds)
      throw UsageError(fmt::format(
          "--time: \"{}\" are {:g} s; tasks are told to stop up to {} s before their end, and "
          "need {:g} s at least",
          time, *seconds, kSecondsToStop + 60, kLeastSeconds));
    options.push_back("--time=" + time);
  }
  if (!partition.empty()) options.push_back("--partition=" + partition);
  options.insert(options.end(), others.begin(), others.end());
  for (const std::string& line : options)
    if (const std::string why = option_refusal(line); !why.empty())
      throw UsageError(fmt::format("--sbatch {}: {}", line, why));
  return options;
}

std::string output_pattern(const std::string& path) {
  std::string pattern;
  for (const char c : path) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern;
}

std::optional<SubmittedJob> submitted_job(const std::string& text) {
  const size_t end = std::min(text.find('\n'), text.size());
  if (end + 1 < text.size()) return std::nullopt;
  const std::string line = text.substr(0, end);
  const size_t semicolon = std::min(line.find(';'), line.size());
  SubmittedJob job{line.substr(0, semicolon), line.substr(std::min(semicolon + 1, line.size()))};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (job.number.empty() || !std::all_of(job.number.begin(), job.number.end(), is_digit))
    return std::nullopt;
  return job;
}

}  // namespace duet::slurm
