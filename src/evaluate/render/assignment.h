// Texts of the form NAME=VALUE.
#pragma once

#include <string>
#include <utility>

namespace duet {

/// Its name and value. Throws UsageError, which mentions the option.
std::pair<std::string, std::string> parse_assignment(const std::string& option,
                                                     const std::string& text);

}  // namespace duet
