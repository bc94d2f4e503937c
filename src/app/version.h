// What this program is made of.
#pragma once

#include <string>

namespace duet {

/// The program, the compiler, the instruction set of this machine and the libraries, a line each.
std::string version_text();

}  // namespace duet
