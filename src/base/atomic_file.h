// Writes files as a whole: a reader sees the old file or the new one, never half of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace duet {

/// Writes under a temporary name in the same directory and renames. Throws std::runtime_error with
/// the reason if that fails (no such directory, no permission, disk full …); the temporary file is
/// removed then, and an existing file stays as it was. What exists and is no regular file (a
/// device, a directory) is not replaced.
void write_file_atomically(const std::string& path, std::span<const uint8_t> bytes);
/// The same with a text.
void write_file_atomically(const std::string& path, std::string_view text);

}  // namespace duet
