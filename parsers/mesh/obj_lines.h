// The lines of an OBJ file. Those that hold the data of meshes are checked and converted here, in
// one pass over their characters; tinyobjloader reads the others as a stream.
// docs/decisions/0002-obj-lines.md says why.
#pragma once

#include <span>
#include <streambuf>
#include <string>
#include <string_view>

#include "math/vector.h"
#include "mesh/byte_reader.h"

namespace duet {

/// A vertex of a face as the file has it: the indices of a position, of texture coordinates and of
/// a normal, which count from 1 or, if negative, back from the last one; 0 stands for none.
using ObjCorner = std::array<int, 3>;

/// Where a file is being read.
struct ObjPlace {
  const std::string& file;
  int line = 0;  ///< from 1

  template <class... Args>
  [[noreturn]] void fail(int at, fmt::format_string<Args...> text, Args&&... args) const {
    throw ReadError(
        fmt::format("{}:{}: {}", file, at, fmt::format(text, std::forward<Args>(args)...)));
  }
};

/// Takes the data of an OBJ file, line by line.
class ObjSink {
 public:
  virtual ~ObjSink() = default;
  /// May be infinite, as numbers beyond all floats are.
  virtual void add_position(const Point3f& p) = 0;
  virtual void add_uv(const Point2f& uv) = 0;
  virtual void add_normal(const Normal3f& n) = 0;
  virtual void add_face(std::span<const ObjCorner> corners) = 0;
};

/// Gives the data to the sink and shows the other lines one at a time. Lines of data that end in a
/// backslash are joined with the next, comments after data are cut off. What is no number or no
/// index throws ReadError. (The stream over this buffer must have exceptions for badbit switched
/// on, or it would swallow them.)
class ObjLines : public std::streambuf {
 public:
  /// `place` is kept up to date.
  ObjLines(ByteReader& in, ObjPlace& place, ObjSink& sink) : in_(in), place_(place), sink_(sink) {}

  /// What the last `mtllib` of the lines given so far says, or "".
  const std::string& library() const { return library_; }

 protected:
  int_type underflow() override;

 private:
  /// The next line, without its end, valid until the next call; false at the end of the file.
  bool next_line(std::string_view& line);
  void note_library(std::string_view text);
  /// A line of data with the lines by which it goes on.
  std::string_view joined(std::string_view line);
  void read_data(std::string_view text);
  /// Takes `count` numbers off the front of a line, of which only the first may have to be there.
  void read_numbers(std::string_view words, int required, std::span<float> numbers) const;
  void read_face(std::string_view words);

  ByteReader& in_;
  ObjPlace& place_;
  ObjSink& sink_;
  std::string text_;
  std::string_view rest_;  ///< of a line that in_ gave, beyond a carriage return within it
  bool has_rest_ = false;
  int line_ = 0;
  std::string library_;
  std::vector<ObjCorner> corners_;  ///< of one face
};

}  // namespace duet
