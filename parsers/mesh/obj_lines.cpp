#include "mesh/obj_lines.h"

#include "mesh/words.h"

namespace duet {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes digits off the front and returns how many there were.
size_t take_digits(std::string_view& s) {
  size_t n = 0;
  while (n < s.size() && is_digit(s[n])) ++n;
  s.remove_prefix(n);
  return n;
}

void take_sign(std::string_view& s) {
  if (!s.empty() && (s[0] == '+' || s[0] == '-')) s.remove_prefix(1);
}

/// [sign] digits [. digits] [e [sign] digits], of which the digits on one side of the point may be
/// missing.
bool is_number(std::string_view s) {
  take_sign(s);
  size_t digits = take_digits(s);
  if (!s.empty() && s[0] == '.') {
    s.remove_prefix(1);
    digits += take_digits(s);
  }
  if (digits == 0) return false;
  if (!s.empty() && (s[0] == 'e' || s[0] == 'E')) {
    s.remove_prefix(1);
    take_sign(s);
    const size_t n = take_digits(s);
    if (n == 0 || n > 4) return false;
  }
  return s.empty();
}

/// position, position/texture, position//normal or position/texture/normal, each an integer of up
/// to nine digits.
bool is_corner(std::string_view s) {
  for (int part = 0; part < 3; ++part) {
    const bool negative = !s.empty() && s[0] == '-';
    if (negative) s.remove_prefix(1);
    const size_t n = take_digits(s);
    if (n > 9 || (n == 0 && (negative || part != 1))) return false;
    if (s.empty()) return n > 0;
    if (s[0] != '/') return false;
    s.remove_prefix(1);
  }
  return false;
}

/// Without what follows a word that begins with #.
std::string_view without_comment(std::string_view text) {
  for (size_t i = text.find('#'); i != text.npos; i = text.find('#', i + 1))
    if (i == 0 || is_space(text[i - 1])) return text.substr(0, i);
  return text;
}

/// True for lines of vertices, normals, texture coordinates and faces.
bool is_data(std::string_view text) {
  const std::string_view keyword = take_word(text, is_space);
  return keyword == "v" || keyword == "vn" || keyword == "vt" || keyword == "f";
}

/// True, and cuts it off, if the text ends with a backslash.
bool take_backslash(std::string& text) {
  const size_t last = text.find_last_not_of(" \t");
  if (last == text.npos || text[last] != '\\') return false;
  text.resize(last);
  return true;
}

}  // namespace

ObjLines::int_type ObjLines::underflow() {
  if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
  text_.clear();
  if (!append_line()) return traits_type::eof();
  first_line_ = line_;
  // Elsewhere a backslash may be part of a file name.
  if (is_data(text_)) {
    while (take_backslash(text_)) {
      text_ += ' ';
      if (!append_line()) break;
    }
    check();
  } else {
    note_library(text_);
  }
  text_ += '\n';
  setg(text_.data(), text_.data(), text_.data() + text_.size());
  return traits_type::to_int_type(*gptr());
}

void ObjLines::note_library(std::string_view text) {
  if (take_word(text, is_space) != "mtllib") return;
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  library_ = text;
}

bool ObjLines::append_line() {
  if (!has_rest_ && !in_.next_line(rest_)) return false;
  if (++line_ == 1 && rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);
  const size_t end = rest_.find('\r');
  text_ += rest_.substr(0, end);
  has_rest_ = end != rest_.npos;
  if (has_rest_) rest_.remove_prefix(end + 1);
  return true;
}

void ObjLines::check() {
  text_.resize(without_comment(text_).size());
  if (text_.find('\0') != text_.npos) fail(first_line_, "not a text file");
  std::string_view words = text_;
  const std::string_view keyword = take_word(words, is_space);
  if (keyword == "f")
    check_corners(text_.size() - words.size());
  else if (keyword == "vt")
    check_numbers(words, 1, 2);
  else
    check_numbers(words, 3, 3);
}

void ObjLines::check_numbers(std::string_view words, int required, int checked) const {
  for (int i = 0; i < checked; ++i) {
    const std::string_view word = take_word(words, is_space);
    if (word.empty() && i < required)
      fail(first_line_, "{} number{} needed", required, required > 1 ? "s are" : " is");
    if (!word.empty() && !is_number(word)) fail(first_line_, "\"{}\" is not a number", word);
  }
}

void ObjLines::check_corners(size_t begin) {
  // After "1/" tinyobjloader would take the next vertex for the missing index.
  const auto ends = [&](size_t i) { return i >= text_.size() || is_space(text_[i]); };
  for (size_t i = text_.size(); i-- > begin;)
    if (text_[i] == '/' && ends(i + 1) && !ends(i - 1)) text_[i] = ' ';
  std::string_view words = std::string_view(text_).substr(begin);
  for (std::string_view word = take_word(words, is_space); !word.empty();
       word = take_word(words, is_space))
    if (!is_corner(word))
      fail(first_line_, "\"{}\" is not a vertex of the form 1, 1/2, 1//3 or 1/2/3", word);
}

}  // namespace duet
