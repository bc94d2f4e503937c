// Durations for people.
#pragma once

#include <string>

namespace duet {

/// "1.2 s", "3 min 20 s", "2 h 5 min".
std::string seconds_text(double seconds);

}  // namespace duet
