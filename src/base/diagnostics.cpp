#include "base/diagnostics.h"

#include <algorithm>

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
  const auto same = [&](const Diagnostic& e) {
    return e.severity == d.severity && e.message == d.message &&
           e.where.to_string() == d.where.to_string();
  };
  if (std::any_of(entries_.begin(), entries_.end(), same)) return;
  entries_.push_back(std::move(d));
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
      size_t diagonal = row[0];
      row[0] = i;
      for (size_t j = 1; j <= b.size(); ++j) {
        const size_t substitute = diagonal + (std::tolower(a[i - 1]) != std::tolower(b[j - 1]));
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
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
