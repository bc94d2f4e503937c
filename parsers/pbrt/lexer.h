// The words of pbrt scene files: directives, strings, numbers and brackets.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace duet::pbrt {

/// What comes next in a file.
enum class Kind : uint8_t { end, word, string, number, open, close };

/// What a file says against the rules of its syntax. The reader reports it and goes on.
struct SyntaxError {
  SourceLocation where;
  std::string message;
};

/// Reads a file, gzipped or not, piece by piece: of its text no more than a block is held.
class Lexer {
 public:
  /// Throws ReadError if there is no such file. Of its text no more than `most` bytes are read.
  explicit Lexer(const std::string& path, uint64_t most = UINT64_MAX);
  /// Reads `text`, which must outlive the lexer; `name` is used in messages.
  Lexer(std::string name, std::string_view text);
  ~Lexer();
  Lexer(const Lexer&) = delete;
  Lexer& operator=(const Lexer&) = delete;

  /// Goes on with another file, and at its end with this one: also in the middle of what belongs
  /// together. Throws as the constructor does.
  void include(const std::string& path);
  /// How many files wait for the end of one that they include.
  size_t depth() const { return outer_.size(); }

  /// Skips white space and comments. A character that nothing begins with throws SyntaxError.
  Kind peek();
  /// Where what peek() has found begins.
  SourceLocation where() const;

  // Each takes what peek() has found.
  std::string take_word();
  /// The text between quotes. Throws SyntaxError if the file or the line ends before.
  std::string take_string();
  /// The numbers that come next, to the end of `values`. Throws SyntaxError at the first that is
  /// none, or is not finite.
  void take_numbers(std::vector<double>& values);
  void take_bracket() { ++in_.next; }

  /// Goes on behind a syntax error: at the next word that begins a line, or the end.
  void skip_to_next_line();

 private:
  struct Source;
  static constexpr size_t kBlock = size_t(1) << 18;
  /// The longest number; strings and words may be longer.
  static constexpr size_t kLongest = 512;

  /// A file, or a text in memory, and how far it is read.
  struct Input {
    std::shared_ptr<const std::string> name;
    std::unique_ptr<Source> source;  ///< null when reading from memory or at the end
    uint64_t most = UINT64_MAX;      ///< bytes that may still be taken from the source
    std::vector<char> buffer;
    const char *begin = nullptr, *next = nullptr, *end = nullptr;
    uint64_t base = 0;        ///< position in the text of begin
    uint64_t line_start = 0;  ///< position in the text of the line's first character
    int line = 1;
  };
  static Input open(const std::string& path, uint64_t most);

  /// Makes sure that `count` bytes can be seen, as far as there are so many.
  void need(size_t count) {
    if (size_t(in_.end - in_.next) < count) refill();
  }
  void refill();
  void new_line(const char* behind) {
    ++in_.line;
    in_.line_start = in_.base + uint64_t(behind - in_.begin);
  }
  double take_number();

  Input in_;
  std::vector<Input> outer_;  ///< those that include in_, the first one first
};

}  // namespace duet::pbrt
