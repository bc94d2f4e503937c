// Why something that a user asked for is not done.
#pragma once

#include <stdexcept>
#include <string>

namespace duet {

/// What is asked for makes no sense, or does not exist.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
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
    } catch (const std::exception& e) {
      failures_ += (failures_.empty() ? "" : "; ") + std::string(e.what());
    }
  }
  /// Throws std::runtime_error with all failures, if there are any.
  void finish() const {
    if (!failures_.empty()) throw std::runtime_error(failures_);
  }

 private:
  std::string failures_;
};

}  // namespace duet
