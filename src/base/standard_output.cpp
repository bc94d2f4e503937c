#include "base/standard_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace duet {

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
