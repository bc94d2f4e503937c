// What a terminal can show.
#pragma once

#include <cstddef>
#include <string_view>

namespace duet {

/// Columns that a text in UTF-8 takes, without characters of double width.
size_t columns(std::string_view text);

}  // namespace duet
