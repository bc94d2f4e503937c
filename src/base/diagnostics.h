// Errors and warnings with their place in a file, gathered so that all of them are reported
// together.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

namespace duet {

/// A place in an input file; the line and column count from 1, and 0 means unknown.
struct SourceLocation {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  /// "file:line:column" as far as it is known.
  std::string to_string() const;
  /// Descriptions compare by what they say, not by where it was said.
  friend bool operator==(const SourceLocation&, const SourceLocation&) { return true; }
};

enum class Severity { warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  SourceLocation where;
  std::string message;
  /// "place: error: message", the form that editors and compilers share.
  std::string to_string() const;
};

/// Collects what went wrong while a scene is read and built.
class Diagnostics {
 public:
  template <class... Args>
  void error(const SourceLocation& where, fmt::format_string<Args...> text, Args&&... args) {
    add({Severity::error, where, fmt::format(text, std::forward<Args>(args)...)});
  }
  template <class... Args>
  void warning(const SourceLocation& where, fmt::format_string<Args...> text, Args&&... args) {
    add({Severity::warning, where, fmt::format(text, std::forward<Args>(args)...)});
  }
  void add(Diagnostic diagnostic);

  const std::vector<Diagnostic>& all() const { return entries_; }
  /// What people read: all errors, but of warnings with the same text only the first, which says
  /// how many there are.
  std::vector<Diagnostic> summary() const;
  size_t error_count() const { return errors_; }
  bool has_errors() const { return errors_ > 0; }

 private:
  std::vector<Diagnostic> entries_;
  std::unordered_set<std::string> seen_;
  size_t errors_ = 0;
};

/// Thrown by readers of one file (a mesh, an image) whose caller knows the place that named it.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The entry of `known` closest to `name` by edit distance, or "" if none is close enough to be
/// meant.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);
/// " (did you mean "x"?)" or "".
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known);

}  // namespace duet
