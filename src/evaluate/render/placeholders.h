// Texts in which {names} stand for something, such as the paths of images.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace duet {

using Placeholders = std::vector<std::pair<std::string, std::string>>;

/// The pattern with every {name} replaced, and {{ by a brace; what stands in their places is not
/// looked into. Throws UsageError, which mentions the option, for names
/// that do not exist.
std::string fill_in(const std::string& option, const std::string& pattern,
                    const Placeholders& names);

/// The pattern that means this text, whatever braces it has.
std::string as_pattern(const std::string& text);

}  // namespace duet
