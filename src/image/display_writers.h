// Encodes images for display as PNG and JPEG files, without OpenImageIO, which takes long to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace duet {

/// Integers encoded with sRGB's curve: rows from the top, channels interleaved (grey, grey and
/// alpha, RGB, or RGB and alpha).
struct DisplayPixels {
  int width, height, channels;
  int bits;  ///< 8: `values` are uint8_t; 16: uint16_t
  const void* values;

  size_t row_bytes() const { return size_t(width) * size_t(channels) * size_t(bits / 8); }
  const uint8_t* row(size_t y) const {
    return static_cast<const uint8_t*>(values) + y * row_bytes();
  }
};

/// The bytes of a PNG file. Throws std::runtime_error if libpng fails.
std::vector<uint8_t> encode_png(const DisplayPixels& pixels);

/// The greatest width and height of a JPEG file (libjpeg's JPEG_MAX_DIMENSION).
inline constexpr int kGreatestJpegSide = 65500;

/// The bytes of a JPEG file of quality 95, each pixel with a colour of its own (4:4:4): 8 bits,
/// one channel or three. Throws std::runtime_error if libjpeg fails.
std::vector<uint8_t> encode_jpeg(const DisplayPixels& pixels);

}  // namespace duet
