#include "evaluate/batch/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace duet::batch {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code ignored;
  fs::path where = fs::temp_directory_path(ignored);
  if (where.empty()) where = "/tmp";
  path_ = (where / "duet-batch-XXXXXX").string();
  if (!mkdtemp(path_.data()))
    throw std::runtime_error(fmt::format("no temporary folder can be made in {}: {}",
                                         where.string(), std::strerror(errno)));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace duet::batch
