#include "image/module_paths.h"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <algorithm>

namespace duet {

namespace fs = std::filesystem;

namespace {

/// The running program, by links followed; empty if that cannot be told.
fs::path program_path() {
  std::error_code error;
  // The name of the program may be relative to a directory that has been left since.
  if (const fs::path p = fs::read_symlink("/proc/self/exe", error); !error) return p;
  // A bare chroot has no /proc.
  const auto name = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return name ? fs::canonical(name, error) : fs::path();
}

}  // namespace

std::vector<fs::path> module_directories() {
  std::vector<fs::path> directories;
  const auto add = [&](const fs::path& directory) {
    if (std::find(directories.begin(), directories.end(), directory) == directories.end())
      directories.push_back(directory);
  };
  std::error_code error;
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&module_directories), &self) && self.dli_fname)
    if (const fs::path p = fs::canonical(self.dli_fname, error); !error) {
      add(p.parent_path());
      add(p.parent_path() / "duet");
    }
  if (const fs::path p = program_path(); !p.empty()) {
    add(p.parent_path());
    add(p.parent_path().parent_path() / "lib" / "duet");
  }
  add(DUET_MODULE_DIR);
  return directories;
}

}  // namespace duet
