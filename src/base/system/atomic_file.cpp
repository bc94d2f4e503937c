#include "base/system/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace duet {

namespace fs = std::filesystem;

namespace {

/// Names for a temporary file that are tried.
constexpr unsigned kMostNames = 10000;
/// Where a file without a name can be found to be given one. Source: open(2), O_TMPFILE.
constexpr const char* kOpenFiles = "/proc/self/fd";

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), target_(path_) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) fail("it exists and is not a regular file");
    // A symbolic link stays one.
    target_ = fs::canonical(target_, error).string();
    if (error) fail(error.message());
  }
#ifdef O_TMPFILE
  const std::string folder = fs::path(target_).parent_path().string();
  if (::access(kOpenFiles, X_OK) == 0)
    file_ = ::open(folder.empty() ? "." : folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
#endif
  // Not every file system has files without names.
  if (file_ < 0)
    file_ = take_temporary_name([](const char* name) {
      return ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    });
}

template <class Take>
int AtomicFile::take_temporary_name(Take take) {
  // Other threads, and processes of other machines, may write the same file now.
  for (unsigned number = 0;; ++number) {
    const std::string name = fmt::format("{}.{}-{}.tmp", target_, getpid(), number);
    const int result = take(name.c_str());
    if (result >= 0) {
      temporary_ = name;
      return result;
    }
    if (errno != EEXIST || number >= kMostNames) fail(std::strerror(errno));
  }
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(const std::string& reason) {
  throw std::runtime_error(fmt::format("{} cannot be written: {}", path_, reason));
}

void AtomicFile::write(std::span<const uint8_t> bytes) {
  write_at(position_, bytes);
  position_ += bytes.size();
}

void AtomicFile::write_at(uint64_t position, std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(file_, bytes.data(), bytes.size(), off_t(position));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(std::strerror(errno));
    bytes = bytes.subspan(size_t(n));
    position += uint64_t(n);
  }
}

void AtomicFile::write(std::string_view text) {
  write(std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

void AtomicFile::sync() {
  // EINVAL: the file system has no disk to wait for.
  if (::fdatasync(file_) != 0 && errno != EINVAL) fail(std::strerror(errno));
}

void AtomicFile::commit() {
  // Only rename() replaces a file, and it wants a name.
  if (temporary_.empty())
    take_temporary_name([link = fmt::format("{}/{}", kOpenFiles, file_)](const char* name) {
      return ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW);
    });
  // Some file systems report a full disk only here.
  if (::close(std::exchange(file_, -1)) != 0) fail(std::strerror(errno));
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(std::strerror(errno));
  temporary_.clear();
}

void write_file_atomically(const std::string& path, std::span<const uint8_t> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file_atomically(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace duet
