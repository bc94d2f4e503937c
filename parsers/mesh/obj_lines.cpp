#include "mesh/obj_lines.h"

#include <charconv>
#include <cstdlib>

#include "mesh/words.h"

namespace duet {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// [sign] digits [. digits] [e [sign] digits], of which the digits on one side of the point may be
/// missing, as the nearest float. False for anything else.
bool to_float(std::string_view s, float& number) {
  const char *p = s.data(), *const end = p + s.size();
  const bool negative = p < end && *p == '-';
  if (negative || (p < end && *p == '+')) ++p;
  // Neither another sign nor "inf" or "nan".
  if (p == end || !(is_digit(*p) || *p == '.')) return false;
  const auto [stop, error] = std::from_chars(p, end, number);
  if (stop != end || error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range)
    number = float(std::strtod(std::string(p, end).c_str(), nullptr));
  if (negative) number = -number;
  return true;
}

/// Takes position, position/texture, position//normal or position/texture/normal off the front,
/// each an integer of up to nine digits; slashes that nothing follows say nothing. False if there
/// is anything else before the next white space.
bool take_corner(const char*& p, const char* end, ObjCorner& corner) {
  const auto word_ends = [&] { return p == end || is_space(*p); };
  corner = {};
  for (int& index : corner) {
    const bool negative = p < end && *p == '-';
    if (negative) ++p;
    const char* const first = p;
    while (p < end && is_digit(*p) && p - first < 9) index = 10 * index + (*p++ - '0');
    const bool is_missing = p == first;
    if (is_missing && (negative || &index == &corner[0])) return false;
    if (negative) index = -index;
    if (word_ends()) return true;
    if (*p++ != '/') return false;
  }
  while (p < end && *p == '/') ++p;
  return word_ends();
}

/// Without what follows a word that begins with #.
std::string_view without_comment(std::string_view text) {
  for (size_t i = text.find('#'); i != text.npos; i = text.find('#', i + 1))
    if (i == 0 || is_space(text[i - 1])) return text.substr(0, i);
  return text;
}

enum class Data { none, position, normal, uv, face };

/// Takes the word off the front that says what a line holds.
Data take_keyword(std::string_view& text) {
  const std::string_view word = take_word(text, is_space);
  if (word.size() == 1)
    return word[0] == 'v' ? Data::position : word[0] == 'f' ? Data::face : Data::none;
  if (word.size() != 2 || word[0] != 'v') return Data::none;
  return word[1] == 'n' ? Data::normal : word[1] == 't' ? Data::uv : Data::none;
}

/// True, and cuts it off, if the text ends with a backslash.
bool take_backslash(std::string_view& text) {
  size_t end = text.size();
  while (end > 0 && is_space(text[end - 1])) --end;
  if (end == 0 || text[end - 1] != '\\') return false;
  text = text.substr(0, end - 1);
  return true;
}

}  // namespace

ObjLines::int_type ObjLines::underflow() {
  if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
  std::string_view line;
  while (next_line(line)) {
    place_.line = line_;
    std::string_view values = line;
    if (take_keyword(values) != Data::none) {
      read_data(joined(line));
      continue;
    }
    // Here a backslash may be part of a file name.
    note_library(line);
    text_.assign(line) += '\n';
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(*gptr());
  }
  return traits_type::eof();
}

void ObjLines::note_library(std::string_view text) {
  if (take_word(text, is_space) != "mtllib") return;
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  library_ = text;
}

bool ObjLines::next_line(std::string_view& line) {
  if (!has_rest_ && !in_.next_line(rest_)) return false;
  if (++line_ == 1 && rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);
  const size_t end = rest_.find('\r');
  line = rest_.substr(0, end);
  has_rest_ = end != rest_.npos;
  if (has_rest_) rest_.remove_prefix(end + 1);
  return true;
}

std::string_view ObjLines::joined(std::string_view line) {
  if (!take_backslash(line)) return line;
  text_ = line;
  for (bool goes_on = true; goes_on && next_line(line);) {
    goes_on = take_backslash(line);
    (text_ += ' ') += line;
  }
  return text_;
}

void ObjLines::read_data(std::string_view text) {
  text = without_comment(text);
  if (text.find('\0') != text.npos) place_.fail(place_.line, "not a text file");
  float n[3]{};
  switch (take_keyword(text)) {
    case Data::face:
      return read_face(text);
    case Data::uv:
      read_numbers(text, 1, {n, 2});
      return sink_.add_uv({n[0], n[1]});
    case Data::normal:
      read_numbers(text, 3, n);
      return sink_.add_normal({n[0], n[1], n[2]});
    default:
      read_numbers(text, 3, n);
      return sink_.add_position({n[0], n[1], n[2]});
  }
}

void ObjLines::read_numbers(std::string_view words, int required, std::span<float> numbers) const {
  for (float& number : numbers) {
    const std::string_view word = take_word(words, is_space);
    if (word.empty()) {
      if (&number - numbers.data() >= required) return;
      place_.fail(place_.line, "{} number{} needed", required, required > 1 ? "s are" : " is");
    }
    if (!to_float(word, number)) place_.fail(place_.line, "\"{}\" is not a number", word);
  }
}

void ObjLines::read_face(std::string_view words) {
  corners_.clear();
  const char *p = words.data(), *const end = p + words.size();
  for (;;) {
    while (p < end && is_space(*p)) ++p;
    if (p == end) return sink_.add_face(corners_);
    std::string_view rest(p, size_t(end - p));
    if (take_corner(p, end, corners_.emplace_back())) continue;
    std::string_view word = take_word(rest, is_space);
    while (word.size() > 1 && word.back() == '/') word.remove_suffix(1);
    place_.fail(place_.line, "\"{}\" is not a vertex of the form 1, 1/2, 1//3 or 1/2/3", word);
  }
}

}  // namespace duet
