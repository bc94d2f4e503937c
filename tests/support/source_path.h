// Where the files of the project are.
#pragma once

#include <string>

namespace duet::test {

/// The absolute path of a file, given relative to the top folder of the sources. Only the file that
/// defines it knows that folder: all other tests compile to the same objects wherever they stand.
std::string source_path(const std::string& path);

}  // namespace duet::test
