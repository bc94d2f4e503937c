// Why something that a user asked for is not done.
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace duet {

inline std::string joined_reasons(const std::vector<std::string>& reasons) {
  std::string all;
  for (const std::string& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return all;
}

/// What is asked for makes no sense, or does not exist.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& mistake) : UsageError(std::vector{mistake}) {}
  /// Several mistakes, found together.
  explicit UsageError(std::vector<std::string> mistakes)
      : std::runtime_error(joined_reasons(mistakes)), mistakes_(std::move(mistakes)) {}
  const std::vector<std::string>& mistakes() const { return mistakes_; }

 private:
  std::vector<std::string> mistakes_;
};

/// Makes several checks and finds the mistakes of all.
class Checks {
 public:
  template <class Check>
  void run(const Check& check) {
    try {
      check();
    } catch (const UsageError& e) {
      mistakes_.insert(mistakes_.end(), e.mistakes().begin(), e.mistakes().end());
    }
  }
  /// Throws UsageError if there are mistakes.
  void finish() const {
    if (!mistakes_.empty()) throw UsageError(mistakes_);
  }

 private:
  std::vector<std::string> mistakes_;
};

/// The scene cannot be used as asked.
class SceneFailure : public std::runtime_error {
 public:
  explicit SceneFailure(const std::string& reason, bool is_printed = false)
      : std::runtime_error(reason), is_printed_(is_printed) {}
  /// Whether the user has been told: what() is then the first of several messages.
  bool is_printed() const { return is_printed_; }

 private:
  bool is_printed_;
};

/// Does several things, each whatever becomes of the others.
class TryAll {
 public:
  template <class Action>
  void run(const Action& action) {
    try {
      action();
    } catch (const std::bad_alloc&) {
      failures_.emplace_back("out of memory");
    } catch (const std::exception& e) {
      failures_.emplace_back(e.what());
    }
  }
  /// Throws std::runtime_error with all failures, if there are any.
  void finish() const {
    if (!failures_.empty()) throw std::runtime_error(joined_reasons(failures_));
  }

 private:
  std::vector<std::string> failures_;
};

}  // namespace duet
