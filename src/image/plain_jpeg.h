// JPEG files of the common kinds, without OpenImageIO, which takes long to load.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "image/image_io.h"

namespace duet {

/// The pixels of a JPEG file that is grey or coloured; nothing for any other: those of printers
/// (CMYK), and what libjpeg finds damaged, about which OpenImageIO has messages. May throw
/// std::bad_alloc.
std::optional<ImageFile> read_plain_jpeg(const std::vector<uint8_t>& bytes);

}  // namespace duet
