#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace duet {

namespace fs = std::filesystem;

namespace {

/// Names for a temporary file that are tried.
constexpr unsigned kMostNames = 10000;

/// Writes all bytes; returns an errno, or 0.
int write_all(int file, std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes = bytes.subspan(size_t(n));
  }
  return 0;
}

}  // namespace

void write_file_atomically(const std::string& path, std::span<const uint8_t> bytes) {
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error(fmt::format("{} cannot be written: {}", path, reason));
  };
  std::error_code error;
  fs::path target = path;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) fail("it exists and is not a regular file");
    // A symbolic link stays one.
    target = fs::canonical(target, error);
    if (error) fail(error.message());
  }
  // Other threads, and processes of other machines, may write the same file now.
  std::string temporary;
  int file = -1;
  for (unsigned number = 0; file < 0; ++number) {
    temporary = fmt::format("{}.{}-{}.tmp", target.string(), getpid(), number);
    file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && (errno != EEXIST || number >= kMostNames)) fail(std::strerror(errno));
  }
  int result = write_all(file, bytes);
  // Some file systems report a full disk only here.
  if (::close(file) != 0 && result == 0) result = errno;
  if (result == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) result = errno;
  if (result != 0) {
    ::unlink(temporary.c_str());
    fail(std::strerror(result));
  }
}

void write_file_atomically(const std::string& path, std::string_view text) {
  write_file_atomically(path,
                        std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

}  // namespace duet
