// Percentages and ratios for people.
#pragma once

#include <string>

namespace duet {

/// A fraction as a percentage with three significant digits and never an exponent: "12.3 %",
/// "0.0012 %"; from 100 on to the unit: "130 %".
std::string percent(double fraction);

/// A ratio with two significant digits and never an exponent: "0.012", "1.3"; from 10 on to the
/// unit: "126".
std::string ratio(double value);

}  // namespace duet
