// Messages to the user, whoever shows them and wherever.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace duet {

class Messages {
 public:
  enum class Level { quiet, normal, verbose };

  virtual ~Messages() = default;
  /// Whether what is written at a level is shown follows from this one.
  virtual Level level() const = 0;
  /// Writes a line as it is. Errors and warnings are shown at every level. Never throws: a message
  /// that cannot be written is no reason to stop.
  virtual void write(Level needed, std::string_view line) noexcept = 0;

  template <class... Args>
  void error(fmt::format_string<Args...> text, Args&&... args) {
    write(Level::quiet, "duet: error: " + fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warning(fmt::format_string<Args...> text, Args&&... args) {
    write(Level::quiet, "duet: warning: " + fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void info(fmt::format_string<Args...> text, Args&&... args) {
    write(Level::normal, fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  void detail(fmt::format_string<Args...> text, Args&&... args) {
    write(Level::verbose, fmt::format(text, std::forward<Args>(args)...));
  }
};

}  // namespace duet
