#include "base/printable.h"

#include <cstddef>
#include <cstdint>

namespace duet {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";

uint8_t byte_at(std::string_view text, size_t i) {
  return i < text.size() ? uint8_t(text[i]) : uint8_t(0);
}

/// How many bytes the character that begins at `i` has; 0 if it is not well-formed (table 3-7 of
/// the Unicode standard).
size_t character_size(std::string_view text, size_t i) {
  const uint8_t first = byte_at(text, i), second = byte_at(text, i + 1);
  if (first < 0x80) return 1;
  const size_t size = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (first < 0xc2 || first > 0xf4) return 0;
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
      (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f))
    return 0;
  for (size_t k = 1; k < size; ++k)
    if ((byte_at(text, i + k) & 0xc0) != 0x80) return 0;
  return size;
}

/// Of ASCII, of Latin 1 (U+0080 to U+009F), and U+FFFE and U+FFFF, which XML forbids.
bool is_control(std::string_view character) {
  const uint8_t first = byte_at(character, 0), second = byte_at(character, 1);
  if (character.size() == 1) return (first < 0x20 && first != '\n') || first == 0x7f;
  if (character.size() == 2) return first == 0xc2 && second < 0xa0;
  return character == "\xef\xbf\xbe" || character == "\xef\xbf\xbf";
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size();) {
    const size_t size = character_size(text, i);
    const std::string_view character = text.substr(i, size);
    if (character == "\t")
      out += ' ';
    else
      out += size == 0 || is_control(character) ? kReplacement : character;
    i += size == 0 ? 1 : size;
  }
  return out;
}

}  // namespace duet
