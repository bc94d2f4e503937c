#include "base/diagnostics.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace duet {

std::string SourceLocation::to_string() const {
  std::string s = file ? *file : std::string("<unknown>");
  if (line > 0) s += fmt::format(":{}", line);
  if (line > 0 && column > 0) s += fmt::format(":{}", column);
  return s;
}

std::string Diagnostic::to_string() const {
  return fmt::format("{}: {}: {}", where.to_string(),
                     severity == Severity::error ? "error" : "warning", message);
}

void Diagnostics::add(Diagnostic d) {
  if (d.severity == Severity::error) ++errors_;
  // The same remark from the same place (a file included twice, a parameter read twice) is one.
  if (seen_.insert(d.to_string()).second) entries_.push_back(std::move(d));
}

std::vector<Diagnostic> Diagnostics::summary() const {
  std::unordered_map<std::string, size_t> counts;
  for (const Diagnostic& d : entries_)
    if (d.severity == Severity::warning) ++counts[d.message];
  std::vector<Diagnostic> result;
  for (const Diagnostic& d : entries_) {
    result.push_back(d);
    if (d.severity != Severity::warning) continue;
    size_t& count = counts[d.message];
    if (count == 0) result.pop_back();
    if (count > 1) result.back().message += fmt::format(" ({} times)", count);
    count = 0;
  }
  return result;
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  // How many letters must be changed, added, removed or exchanged with their neighbours.
  const auto distance = [](const std::string& a, const std::string& b) {
    std::vector<size_t> before, last(b.size() + 1), row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    const auto same = [&](size_t i, size_t j) { return std::tolower(a[i]) == std::tolower(b[j]); };
    for (size_t i = 1; i <= a.size(); ++i) {
      before = std::exchange(last, row);
      row[0] = i;
      for (size_t j = 1; j <= b.size(); ++j) {
        row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + !same(i - 1, j - 1)});
        if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
          row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    return row[b.size()];
  };
  std::string best;
  size_t best_distance = std::max<size_t>(1, name.size() / 3) + 1;
  if (name.size() > 100) return best;
  for (const std::string& k : known) {
    const size_t d = distance(name, k);
    if (d < best_distance) best_distance = d, best = k;
  }
  return best;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known) {
  const std::string near = nearest_name(name, known);
  return near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near);
}

}  // namespace duet
