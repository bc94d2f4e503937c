// Where libraries that are loaded while the program runs may be.
#pragma once

#include <filesystem>
#include <vector>

namespace duet {

/// The directories in which they are looked for, one after the other: that of the program or
/// library that this code is in, a folder there, and where an installation puts modules.
std::vector<std::filesystem::path> module_directories();

}  // namespace duet
