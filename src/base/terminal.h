// What a terminal can show.
#pragma once

#include <cstddef>
#include <string_view>

namespace duet {

/// Columns of the terminal that the stream (STDOUT_FILENO or STDERR_FILENO) is; 80 if it is none.
size_t terminal_width(int stream);

/// Columns that a text in UTF-8 takes, without characters of double width.
size_t columns(std::string_view text);

}  // namespace duet
