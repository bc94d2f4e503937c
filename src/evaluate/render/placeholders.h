// Texts in which {names} stand for something, such as the paths of images.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace duet {

using Placeholders = std::vector<std::pair<std::string, std::string>>;

/// The pattern with every {name} replaced. Throws UsageError, which mentions the option, for names
/// that do not exist.
std::string fill_in(const std::string& option, const std::string& pattern,
                    const Placeholders& names);

}  // namespace duet
