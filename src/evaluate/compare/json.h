// Comparisons for programs to read.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "evaluate/compare/compare.h"

namespace duet {

/// All figures, the tests for bias and the verdict; or why there are none.
nlohmann::ordered_json comparison_json(const CompareSettings& settings,
                                       const Comparison& comparison);
/// An array of these, with the names of the images.
nlohmann::ordered_json comparisons_json(const CompareSettings& settings,
                                        const std::vector<Comparison>& all);

}  // namespace duet
