// Errors and warnings of one scene, limited in number.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"

namespace duet {

/// Passes messages on until there are too many of them to be read.
class Report {
 public:
  explicit Report(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  template <class... Args>
  void error(const SourceLocation& where, fmt::format_string<Args...> text, Args&&... args) {
    if (errors_++ < kMost) diagnostics_.error(where, text, std::forward<Args>(args)...);
  }
  template <class... Args>
  void warning(const SourceLocation& where, fmt::format_string<Args...> text, Args&&... args) {
    if (warnings_++ < kMost) diagnostics_.warning(where, text, std::forward<Args>(args)...);
  }
  bool has_errors() const { return errors_ > 0; }
  /// Whether further messages are held back, so that nobody needs to think of helpful ones.
  bool is_full() const { return errors_ >= kMost || warnings_ >= kMost; }

  /// The keys of `names` for did_you_mean(). None if nobody will read the hint or if the search for
  /// the nearest one among so many would take too long.
  template <class Map>
  std::vector<std::string> names_for_hint(const Map& names) const {
    std::vector<std::string> keys;
    if (is_full() || names.size() >= kMostNames) return keys;
    for (const auto& [key, value] : names) keys.push_back(key);
    std::sort(keys.begin(), keys.end());
    return keys;
  }

  /// Says how many messages were held back; `file` names the scene.
  void finish(const SourceLocation& file) {
    if (errors_ > kMost) diagnostics_.error(file, "and {} more errors", errors_ - kMost);
    if (warnings_ > kMost) diagnostics_.warning(file, "and {} more warnings", warnings_ - kMost);
  }

 private:
  static constexpr size_t kMost = 100, kMostNames = 5000;
  Diagnostics& diagnostics_;
  size_t errors_ = 0, warnings_ = 0;
};

}  // namespace duet
