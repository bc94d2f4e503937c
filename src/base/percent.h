// Percentages for people.
#pragma once

#include <string>

namespace duet {

/// A fraction as a percentage with three significant digits and never an exponent: "12.3 %",
/// "0.0012 %"; from 100 on to the unit: "130 %".
std::string percent(double fraction);

}  // namespace duet
