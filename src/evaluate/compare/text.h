// Comparisons for people to read, as lines of text.
#pragma once

#include <string>
#include <vector>

#include "evaluate/compare/compare.h"

namespace duet {

/// The figures of one comparison, a line each, what they miss, and the verdict.
std::string comparison_text(const Comparison& comparison);

/// A line for each comparison, and the summary.
std::string table_text(const CompareSettings& settings, const std::vector<Comparison>& all);

}  // namespace duet
