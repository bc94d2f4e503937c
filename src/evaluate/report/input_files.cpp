#include "evaluate/report/input_files.h"

#include <algorithm>
#include <filesystem>

#include "files/file_access.h"

namespace duet {

FileAccess InputFiles::watch(FileAccess access) {
  access = with_disk(std::move(access));
  access.read = [this, read = access.read](const std::string& path) {
    std::optional<std::string> text = read(path);
    if (text) texts_.add(*text);
    return text;
  };
  access.exists = [this, exists = access.exists](const std::string& path) {
    std::error_code ignored;
    const bool found = exists(path);
    if (found && std::filesystem::is_regular_file(path, ignored) &&
        std::find(found_.begin(), found_.end(), path) == found_.end())
      found_.push_back(path);
    return found;
  };
  return access;
}

Fingerprint InputFiles::fingerprint() const {
  Fingerprint all = texts_;
  for (const std::string& path : found_) all.add_file(path);
  return all;
}

}  // namespace duet
