// Turns the texts of the command line into numbers; what makes no sense is a UsageError.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "math/vector.h"

namespace duet {

/// Units and what a number with them is multiplied by; "" is a number without a unit.
using Units = std::vector<std::pair<std::string, double>>;

/// A number from `least` to `most` (after multiplication) with one of the units and nothing else.
double parse_amount(const std::string& option, const std::string& text, const Units& units,
                    double least, double most);

/// A whole number from `least` to `most`.
uint64_t parse_whole(const std::string& option, const std::string& text, uint64_t least,
                     uint64_t most);

/// Exactly `count` whole numbers between separators. `form` shows the user what is expected.
std::vector<int> parse_integers(const std::string& option, const std::string& text, char separator,
                                size_t count, const char* form);

/// The size of an image as WxH, neither side shorter than `least`.
Point2i parse_size(const std::string& option, const std::string& text, int least);

/// A duration in seconds: 90, 90s, 10m, 2h.
double parse_seconds(const std::string& option, const std::string& text);

}  // namespace duet
