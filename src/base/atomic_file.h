// Writes files as a whole: a reader sees the old file or the new one, never half of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace duet {

/// A file that is written under a temporary name in the same directory and gets its own name when
/// it is whole. All functions throw std::runtime_error with the reason if that fails (no such
/// directory, no permission, disk full …); an existing file stays as it was then.
class AtomicFile {
 public:
  /// What exists and is no regular file (a device, a directory) is not replaced.
  explicit AtomicFile(const std::string& path);
  /// Removes what has not been committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes at a number of bytes from the beginning.
  void write(uint64_t position, std::span<const uint8_t> bytes);
  /// The last call.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  std::string path_, target_, temporary_;
  int file_ = -1;
};

/// The same for what is in memory.
void write_file_atomically(const std::string& path, std::span<const uint8_t> bytes);
/// The same with a text.
void write_file_atomically(const std::string& path, std::string_view text);

}  // namespace duet
