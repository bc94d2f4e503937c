// Reads a file (or memory) in blocks, as bytes, lines and words; what is missing is an error with
// its place.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/system/files.h"

namespace duet {

class ByteReader {
 public:
  /// The longest stretch that peek() and take() can show at once, and the longest line or word.
  static constexpr size_t kBlock = size_t(1) << 18;

  /// Opens a file. Throws ReadError if it cannot be read or is not a regular file.
  explicit ByteReader(const std::string& path);
  /// Reads from memory, which must outlive the reader; `name` is used in messages.
  ByteReader(std::string name, std::span<const uint8_t> memory);

  const std::string& name() const { return name_; }
  /// Length of the whole file in bytes.
  uint64_t size() const { return size_; }
  uint64_t position() const { return block_end_ - available(); }
  uint64_t remaining() const { return size_ - position(); }
  /// Continues at an absolute position, which must not be beyond the end.
  void seek(uint64_t position);

  /// The next `count` bytes, or as many as are left; they are not consumed. Valid until the next
  /// call.
  std::span<const uint8_t> peek(size_t count) {
    if (available() < count) refill(count);
    return {next_, std::min(count, available())};
  }
  /// Consumes bytes that peek() has shown.
  void skip(size_t count) { next_ += count; }
  /// The next `count` ≤ kBlock bytes, consumed. Valid until the next call. `what` is for the
  /// message if the file ends before.
  const uint8_t* take(size_t count, const char* what) {
    if (available() < count) {
      refill(count);
      if (available() < count) fail("the file ends in the middle of {}", what);
    }
    const uint8_t* p = next_;
    next_ += count;
    return p;
  }

  /// A number of a binary file, with its lowest byte first.
  template <class T>
  T take_value(const char* what) {
    static_assert(std::endian::native == std::endian::little, "the machine's order is the file's");
    T value;
    std::memcpy(&value, take(sizeof(T), what), sizeof(T));
    return value;
  }

  /// The next line without its end (LF or CR LF); false at the end of the file. The text is valid
  /// until the next call. Lines and words count: see line().
  bool next_line(std::string_view& text);
  /// The next word between white space; empty at the end of the file.
  std::string_view next_word();
  /// The line, from 1, of what next_line() or next_word() returned last.
  int line() const { return line_; }

  /// Throws ReadError "file: message", or "file:line: message" while a text is read.
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw ReadError(place() + ": " + fmt::format(text, std::forward<Args>(args)...));
  }
  /// From here on messages name no line: the rest of the file is binary.
  void end_text() { line_ = 0; }

 private:
  size_t available() const { return size_t(end_ - next_); }
  /// Moves what is left to the front of the buffer and reads on, until `count` bytes are there.
  void refill(size_t count);
  std::string place() const;

  std::string name_;
  std::optional<InputFile> file_;  ///< unless it is memory that is read
  std::vector<uint8_t> buffer_;
  const uint8_t* begin_ = nullptr;  ///< the block in memory
  const uint8_t* next_ = nullptr;
  const uint8_t* end_ = nullptr;
  uint64_t block_end_ = 0;  ///< position in the file of end_
  uint64_t size_ = 0;
  int line_ = 0;
  int pending_lines_ = 1;  ///< line ends passed since the last text, to be added to line_
};

/// What `parse` makes of a file; a lack of memory is the file's fault, too.
template <class Parse>
auto parse_file(const std::string& path, const Parse& parse) {
  ByteReader in(path);
  try {
    return parse(in);
  } catch (const std::bad_alloc&) {
    in.end_text();
    in.fail("is too large for the memory");
  }
}

}  // namespace duet
