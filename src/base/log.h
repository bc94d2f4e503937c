// Messages to the user: all go to standard error, and to a file if one is set.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace duet::log {

enum class Level { quiet, normal, verbose };

void set_level(Level level);
Level level();
/// Messages of every level also go to this file. Throws std::runtime_error if it cannot be written.
void open_file(const std::string& path);

/// Writes a line as it is. Errors and warnings are shown at every level.
void write(Level needed, std::string_view line);

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

/// Something is about to be written; whoever draws a progress bar removes it first.
void set_before_write(void (*hook)());

}  // namespace duet::log
