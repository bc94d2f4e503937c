#include "base/terminal.h"

#include <sys/ioctl.h>

#include <algorithm>

namespace duet {

size_t terminal_width(int stream) {
  winsize size{};
  return ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

size_t columns(std::string_view text) {
  const auto begins_character = [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  };
  return size_t(std::count_if(text.begin(), text.end(), begins_character));
}

}  // namespace duet
