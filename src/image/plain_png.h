// PNG files of the common kinds, without OpenImageIO, which takes long to load.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "image/image_io.h"

namespace duet {

/// The pixels of a PNG file of 8 bits per channel, grey or coloured, with or without an alpha
/// channel, whose rows stand in order; nothing for any other: interlaced files, palettes,
/// transparent colours, 16 bits, and what libpng finds damaged, about which OpenImageIO has
/// messages. May throw std::bad_alloc.
std::optional<ImageFile> read_plain_png(const std::vector<uint8_t>& bytes);

}  // namespace duet
