#include "image/module_paths.h"

#include <algorithm>

#include "base/system/process.h"
#include "base/system/shared_library.h"

namespace duet {

namespace fs = std::filesystem;

std::vector<fs::path> module_directories() {
  std::vector<fs::path> directories;
  const auto add = [&](const fs::path& directory) {
    if (std::find(directories.begin(), directories.end(), directory) == directories.end())
      directories.push_back(directory);
  };
  std::error_code error;
  if (const fs::path p = fs::canonical(own_library(), error); !error) {
    add(p.parent_path());
    add(p.parent_path() / "duet");
  }
  // The name that the program was called by may be relative to a directory that has been left
  // since.
  if (const fs::path p = own_program(); !p.empty()) {
    add(p.parent_path());
    add(p.parent_path().parent_path() / "lib" / "duet");
  }
  add(DUET_MODULE_DIR);
  return directories;
}

}  // namespace duet
