#include "base/readable.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/diagnostics.h"
#include "base/system/files.h"

namespace duet {

std::string unreadable_reason(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (error) return error.message();
  if (std::filesystem::is_directory(status)) return "it is a directory";
  if (!std::filesystem::is_regular_file(status)) return "it is not a regular file";
  return open_for_reading(path) ? "" : std::strerror(errno);
}

void refuse_pipe(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_other(path, ignored)) throw ReadError(path + ": is not a regular file");
}

}  // namespace duet
