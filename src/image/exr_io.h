// OpenEXR files in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image_facts.h"
#include "image/image_io.h"

namespace duet {

/// True if the bytes begin as an OpenEXR file does.
bool is_exr(const std::vector<uint8_t>& bytes);
/// Throws ReadError; `path` is for its message.
ImageFile decode_exr(const std::string& path, const std::vector<uint8_t>& bytes);
/// The attributes of a file's first part, and whether its last pixels are there. Throws ReadError.
ImageFacts exr_facts(const std::string& path);
/// Throws an exception derived from std::exception.
std::vector<uint8_t> encode_exr(const Image& image, const ExrOptions& options);

}  // namespace duet
