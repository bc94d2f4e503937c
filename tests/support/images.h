// Small image files of simple formats, made byte by byte, and whether files are read right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "support/serialized.h"

namespace duet::test {

/// A PNG file; `rows` holds the scan lines, each after its filter byte, most significant byte
/// first. `colour` is 0 for grey, 2 for RGB, 4 for grey with alpha, 6 for RGB with alpha.
std::string png(uint32_t width, uint32_t height, int bits, int colour, const std::string& rows);

/// 24-bit BMP, `rows` from the bottom, blue first, each padded to four bytes.
std::string bmp(int32_t width, int32_t height, const std::string& rows);

/// Uncompressed TGA from the top, blue first, with alpha if bits is 32.
std::string tga(uint16_t width, uint16_t height, int bits, const std::string& rows);

/// Uncompressed RGB TIFF in one strip.
std::string tiff(uint32_t width, uint32_t height, const std::string& pixels);

/// Radiance HDR without run lengths.
std::string hdr(int width, int height, const std::string& rgbe);

/// Whether a file was read, and as OpenImageIO reads it; `kind` as in codec_module.h.
bool is_read_as_by_the_module(const std::optional<ImageFile>& read, const char* kind,
                              const std::vector<uint8_t>& file);

}  // namespace duet::test
