// Writes files as a whole: a reader sees the old file or the new one, never half of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace duet {

/// A file that is written piece by piece under a temporary name in the same directory, and gets its
/// name in the end; without that nothing stays of it. What write_file_atomically() says of errors
/// holds here, too.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  void write(std::span<const uint8_t> bytes);
  void write(std::string_view text);
  /// Writes at a number of bytes from the beginning, wherever the pieces before are.
  void write_at(uint64_t position, std::span<const uint8_t> bytes);
  /// As it was given.
  const std::string& path() const { return path_; }
  /// Gives the file its name. Nothing can be written afterwards.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& reason);

  std::string path_, target_, temporary_;
  int file_ = -1;
  uint64_t position_ = 0;  ///< of the next piece
};

/// Writes under a temporary name in the same directory and renames. Throws std::runtime_error with
/// the reason if that fails (no such directory, no permission, disk full …); the temporary file is
/// removed then, and an existing file stays as it was. What exists and is no regular file (a
/// device, a directory) is not replaced.
void write_file_atomically(const std::string& path, std::span<const uint8_t> bytes);
/// The same with a text.
void write_file_atomically(const std::string& path, std::string_view text);

}  // namespace duet
