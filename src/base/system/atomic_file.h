// Writes files as a whole: a reader sees the old file or the new one, never half of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace duet {

/// A file that is written piece by piece in the same directory, and gets its name in the end;
/// without that nothing stays of it. Until then it has no name, so that nothing stays even if the
/// process is killed, or a temporary one where the system wants that. What write_file_atomically()
/// says of errors holds here, too.
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
  /// Waits until all that was written is on the disk. Without this a machine that loses its power
  /// after commit() may keep the new name and not the contents.
  void sync();
  /// Gives the file its name. Nothing can be written afterwards.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& reason);
  /// Calls `take(name)` for temporary names until one is free. Returns what it returns, which is
  /// negative and sets errno if a name cannot be taken.
  template <class Take>
  int take_temporary_name(Take take);

  std::string path_, target_;
  std::string temporary_;  ///< the name that the file has now; empty if it has none
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
