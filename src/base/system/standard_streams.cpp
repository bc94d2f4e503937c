#include "base/system/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <initializer_list>
#include <stdexcept>

namespace duet {

namespace {

int number_of(StandardStream stream) {
  switch (stream) {
    case StandardStream::input:
      return STDIN_FILENO;
    case StandardStream::output:
      return STDOUT_FILENO;
    case StandardStream::error:
      break;
  }
  return STDERR_FILENO;
}

}  // namespace

bool is_terminal(StandardStream stream) {
  return isatty(number_of(stream)) != 0;
}

size_t terminal_width(StandardStream stream) {
  winsize size{};
  return ioctl(number_of(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // A new file gets the lowest number that is free.
    if (fcntl(stream, F_GETFD) == -1)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool is_standard_output(const std::string& path) {
  return path.starts_with(kStandardOutput + ".");
}

std::string standard_output_refusal() {
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  if (flags == -1 || (flags & O_ACCMODE) == O_RDONLY) return "standard output is closed";
  if (isatty(STDOUT_FILENO)) return "standard output is a terminal; send it to a file or a program";
  return "";
}

void write_standard_output(std::span<const uint8_t> bytes) {
  // A reader that has gone is a failed write, not the end of the program.
  std::signal(SIGPIPE, SIG_IGN);
  while (!bytes.empty()) {
    const ssize_t n = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw std::runtime_error(
          fmt::format("standard output cannot be written: {}", std::strerror(errno)));
    bytes = bytes.subspan(size_t(n));
  }
}

}  // namespace duet
