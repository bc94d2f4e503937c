#include "base/memory_limit.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace duet {

namespace {

void lower_by_environment(MemoryLimit& limit) {
  const char* text = std::getenv(kMemoryLimitVariable);
  if (!text) return;
  char* end = nullptr;
  const double bytes = std::strtod(text, &end);
  // Written so that NaN is refused.
  if (end == text || *end != '\0' || !(bytes > 0))
    throw std::runtime_error(
        fmt::format("{}: \"{}\" is not a number of bytes", kMemoryLimitVariable, text));
  if (bytes < limit.bytes)
    limit = {bytes, std::string("environment variable ") + kMemoryLimitVariable};
}

}  // namespace

MemoryLimit memory_limit(const std::filesystem::path& root) {
  MemoryLimit limit = system_memory_limit(root);
  lower_by_environment(limit);
  return limit;
}

std::string memory_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes * 1e-6);
  return fmt::format("{:.{}f} GB", bytes * 1e-9, bytes < 1e10 ? 2 : bytes < 1e11 ? 1 : 0);
}

}  // namespace duet
