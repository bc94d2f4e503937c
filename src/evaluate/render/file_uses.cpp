#include "evaluate/render/file_uses.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/failures.h"
#include "base/system/standard_streams.h"
#include "evaluate/render/scene_operand.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// Streams and devices hold nothing that could be lost.
bool is_file(const std::string& path) {
  if (path.empty() || path == "-" || path == kStandardInput || is_standard_output(path))
    return false;
  std::error_code ignored;
  return !fs::is_other(path, ignored);
}

}  // namespace

std::string file_behind(const std::string& path) {
  std::error_code error;
  // A relative name of a file that is not there would stay relative.
  const fs::path whole = fs::absolute(path, error);
  const fs::path found = fs::weakly_canonical(whole, error);
  return (error ? whole.lexically_normal() : found).string();
}

void FileUses::read(const std::string& use, const std::string& path) {
  if (is_file(path)) uses_.try_emplace(file_behind(path), Use{use, path});
}

void FileUses::write(const std::string& use, const std::string& path, const std::string& allowed) {
  if (!is_file(path)) return;
  const auto [other, is_new] = uses_.try_emplace(file_behind(path), Use{use, path});
  if (is_new || (!allowed.empty() && other->second.name == allowed)) return;
  throw UsageError(fmt::format("{} {}: this file has another use in this call: {} {}", use, path,
                               other->second.name, other->second.path));
}

}  // namespace duet
