// Where the failure catalogue is.
#include <filesystem>

#include "evaluate/stability/catalogue.h"
#include "image/module_paths.h"

namespace duet::stability {

namespace fs = std::filesystem;

std::string catalogue_folder() {
  std::vector<fs::path> folders;
  // Packages are built for one place and unpacked in another: from bin, lib or lib/ARCHITECTURE.
  for (const fs::path& directory : module_directories())
    for (const fs::path& prefix : {directory.parent_path(), directory.parent_path().parent_path()})
      folders.push_back(prefix / "share" / "duet" / "stability");
  folders.push_back(DUET_STABILITY_SOURCE);
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (fs::exists(folder / "catalogue.json", ignored)) return folder.string();
  return DUET_STABILITY_INSTALLED;
}

}  // namespace duet::stability
