// Errors and warnings of one scene, limited in number.
#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
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
    if (mutes_ > 0) return;
    if (errors_++ < kMost) diagnostics_.error(where, text, std::forward<Args>(args)...);
  }
  template <class... Args>
  void warning(const SourceLocation& where, fmt::format_string<Args...> text, Args&&... args) {
    if (mutes_ > 0) return;
    if (warnings_++ < kMostWarnings)
      add_warning({Severity::warning, where, fmt::format(text, std::forward<Args>(args)...)});
    else
      ++warnings_held_;
  }

  /// Nothing is reported while one lives, if `when` holds.
  class Mute {
   public:
    explicit Mute(Report& report, bool when = true) : report_(report), count_(when ? 1 : 0) {
      report_.mutes_ += count_;
    }
    ~Mute() { report_.mutes_ -= count_; }
    Mute(const Mute&) = delete;
    Mute& operator=(const Mute&) = delete;

   private:
    Report& report_;
    int count_;
  };
  bool is_muted() const { return mutes_ > 0; }
  bool has_errors() const { return errors_ > 0; }
  /// Whether further messages are held back, so that nobody needs to think of helpful ones.
  bool is_full() const {
    return errors_ >= kMost || warnings_ >= kMostWarnings || kinds_.size() >= kMost;
  }

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

  /// What `read` returns; nothing, after an error at `where`, if it throws ReadError.
  template <class Read>
  std::optional<std::invoke_result_t<Read>> from_file(const SourceLocation& where, Read read) {
    try {
      return read();
    } catch (const ReadError& e) {
      error(where, "{}", e.what());
      return std::nullopt;
    }
  }

  /// Says how many messages were held back; `file` names the scene.
  void finish(const SourceLocation& file) {
    if (errors_ > kMost) diagnostics_.error(file, "and {} more errors", errors_ - kMost);
    if (warnings_held_ > 0) diagnostics_.warning(file, "and {} more warnings", warnings_held_);
  }

 private:
  /// Warnings that say the same of different places are one kind, which people read once.
  static constexpr size_t kMost = 100, kMostWarnings = 10000, kMostNames = 5000;

  void add_warning(Diagnostic warning) {
    if (kinds_.size() >= kMost && !kinds_.contains(warning.message)) {
      ++warnings_held_;
      return;
    }
    kinds_.insert(warning.message);
    diagnostics_.add(std::move(warning));
  }

  Diagnostics& diagnostics_;
  size_t errors_ = 0, warnings_ = 0, warnings_held_ = 0;
  std::set<std::string> kinds_;
  int mutes_ = 0;
};

}  // namespace duet
