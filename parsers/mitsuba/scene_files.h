// Looks for the files that a scene names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mitsuba/mitsuba.h"

namespace duet {

/// `access` with what it leaves open done on the disk.
FileAccess with_disk(FileAccess access);

/// The folder of a file, "." if it has none in its name.
std::string folder_of(const std::string& path);

/// The file or folder `name` in the first of `folders` that has it. Backslashes, as scenes made on
/// Windows have them, are understood as slashes if there is no such file otherwise.
std::optional<std::string> find_file(const std::string& name,
                                     const std::vector<std::string>& folders,
                                     const FileAccess& access);

/// The path with the current folder before it, if it is relative.
std::string absolute_path(const std::string& path);

/// `file "x" not found (looked in …)`
std::string not_found(const std::string& name, const std::vector<std::string>& folders);

}  // namespace duet
