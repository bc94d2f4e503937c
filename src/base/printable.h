// Texts from elsewhere, made fit for terminals, XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace duet {

/// The text with U+FFFD in the place of every byte that is not UTF-8 and of every control character
/// but line feeds; tabulators become spaces.
std::string printable(std::string_view text);

}  // namespace duet
