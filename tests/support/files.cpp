#include "support/files.h"

#include <unistd.h>

namespace duet::test {

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = (std::filesystem::temp_directory_path() / "duet-test-XXXXXX").string();
  path_ = mkdtemp(pattern.data());
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryDirectory::path(const std::string& name) const {
  return (path_ / name).string();
}

std::string TemporaryDirectory::write(const std::string& name, std::string_view contents) const {
  // Some file systems wait for the disk when an old file is emptied.
  std::filesystem::remove(path(name));
  std::ofstream(path(name), std::ios::binary) << contents;
  return path(name);
}

size_t TemporaryDirectory::count() const {
  return size_t(std::distance(std::filesystem::directory_iterator(path_), {}));
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace duet::test
