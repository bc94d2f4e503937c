// Why a file cannot be read.
#pragma once

#include <string>

namespace duet {

/// Empty, or the reason why the path cannot be opened as a regular file: "No such file or
/// directory", "Permission denied", "it is a directory" …
std::string unreadable_reason(const std::string& path);

/// Throws ReadError if the path is there and neither a file nor a folder: opening a pipe would wait
/// for who writes to it.
void refuse_pipe(const std::string& path);

}  // namespace duet
