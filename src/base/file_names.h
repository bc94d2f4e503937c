// Names of files.
#pragma once

#include <string>

namespace duet {

/// The extension of a path in lower case, with its dot: ".exr" of "folder/image.EXR", or "".
std::string extension_of(const std::string& path);

/// The path of the same file, which no program takes for an option: "./-a" for "-a".
std::string as_operand(const std::string& path);

}  // namespace duet
