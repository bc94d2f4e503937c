// Command lines as a shell reads them.
#pragma once

#include <string>
#include <vector>

namespace duet {

/// An argument as a POSIX shell would have to be given it.
std::string shell_quoted(const std::string& argument);
/// All of them, with spaces between.
std::string shell_quoted(const std::vector<std::string>& arguments);

}  // namespace duet
