#include "base/file_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace duet {

std::string extension_of(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return e;
}

std::string as_operand(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

}  // namespace duet
