#include "evaluate/batch/temporary_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "base/system/files.h"

namespace duet::batch {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code ignored;
  fs::path where = fs::temp_directory_path(ignored);
  if (where.empty()) where = "/tmp";
  std::error_code error;
  path_ = make_temporary_folder((where / "duet-batch-").string(), error);
  if (error)
    throw std::runtime_error(
        fmt::format("no temporary folder can be made in {}: {}", where.string(), error.message()));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace duet::batch
