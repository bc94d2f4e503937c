// Words of a line of text.
#pragma once

#include <string_view>

namespace duet {

/// Takes the first word off `text`, with the white space before it; empty if there is none.
/// (string_view::find_first_of is several times slower, and every word of a mesh passes here.)
template <class IsSpace>
std::string_view take_word(std::string_view& text, const IsSpace& is_space) {
  size_t begin = 0;
  while (begin < text.size() && is_space(text[begin])) ++begin;
  size_t end = begin;
  while (end < text.size() && !is_space(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

}  // namespace duet
