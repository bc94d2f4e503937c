#include "base/terminal.h"

#include <algorithm>

namespace duet {

size_t columns(std::string_view text) {
  const auto begins_character = [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  };
  return size_t(std::count_if(text.begin(), text.end(), begins_character));
}

}  // namespace duet
