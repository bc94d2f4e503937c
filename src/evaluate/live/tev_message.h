// Messages to tev, a viewer of images that other programs may send it (Thomas Müller,
// https://github.com/Tom94/tev; the format is that of its src/Ipc.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace duet {

/// A message begins with its length in bytes, itself included, as uint32, and its kind as uint8;
/// then come its fields: int32 and float little-endian, texts with a zero at their end, booleans as
/// uint8.

/// Makes an image of this name, size and these channels, without values; one of that name that is
/// there already is replaced.
std::vector<uint8_t> tev_create_image(const std::string& name, const Image& image);

/// The values of one channel, rows from the top.
std::vector<uint8_t> tev_update_channel(const std::string& name, const Image& image,
                                        size_t channel);

}  // namespace duet
