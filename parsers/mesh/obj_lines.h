// Feeds an OBJ file to tinyobjloader line by line, after checking what tinyobjloader takes on
// trust.
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

#include "mesh/byte_reader.h"

namespace duet {

/// The stream shows one line at a time, so that whoever reads it knows which line it is. Lines that
/// end in a backslash are joined with the next, comments after data are cut off. tinyobjloader
/// reads what is no number as 0 and lets indices overflow: such lines throw ReadError here. (The
/// stream over this buffer must have exceptions for badbit switched on, or it would swallow them.)
class ObjLines : public std::streambuf {
 public:
  explicit ObjLines(ByteReader& in) : in_(in) {}

  /// The line, from 1, that the characters given last stand in.
  int line() const { return first_line_; }
  /// What the last `mtllib` of the lines given so far says, or "".
  const std::string& library() const { return library_; }
  template <class... Args>
  [[noreturn]] void fail(int line, fmt::format_string<Args...> text, Args&&... args) const {
    throw ReadError(
        fmt::format("{}:{}: {}", in_.name(), line, fmt::format(text, std::forward<Args>(args)...)));
  }

 protected:
  int_type underflow() override;

 private:
  /// Appends the next line, without its end, to the text.
  bool append_line();
  void note_library(std::string_view text);
  void check();
  void check_numbers(std::string_view words, int required, int checked) const;
  /// Also takes off slashes that nothing follows. `begin` is where the vertices begin.
  void check_corners(size_t begin);

  ByteReader& in_;
  std::string text_;
  std::string_view rest_;  ///< of a line that in_ gave, beyond a carriage return within it
  bool has_rest_ = false;
  int line_ = 0, first_line_ = 0;
  std::string library_;
};

}  // namespace duet
