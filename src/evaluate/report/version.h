// What this build of Duet is made of.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace duet {

/// The name of something and its version.
using Version = std::pair<std::string, std::string>;

/// Duet, the compiler, the instruction set of this machine and the libraries.
std::vector<Version> versions();

}  // namespace duet
