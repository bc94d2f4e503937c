// How much memory there is for this process.
#pragma once

#include <filesystem>
#include <string>

#include "base/system/memory.h"

namespace duet {

/// What the system allows (system_memory_limit), which the environment variable
/// kMemoryLimitVariable can lower further. Throws std::runtime_error if that is not a number of
/// bytes.
MemoryLimit memory_limit(const std::filesystem::path& root = "/");

/// What `duet batch` tells the renders that share the memory.
inline constexpr const char* kMemoryLimitVariable = "DUET_MEMORY_LIMIT";

/// For people: "512 MB", "1.23 GB".
std::string memory_text(double bytes);

}  // namespace duet
