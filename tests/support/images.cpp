#include "support/images.h"

#include <zlib.h>

#include "image/codecs.h"

namespace duet::test {

std::string png(uint32_t width, uint32_t height, int bits, int colour, const std::string& rows) {
  const auto chunk = [](const std::string& body) {
    const auto crc =
        uint32_t(crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size())));
    return pack_swapped(uint32_t(body.size() - 4)) + body + pack_swapped(crc);
  };
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR" + pack_swapped(width, height) +
               pack(uint8_t(bits), uint8_t(colour), uint8_t(0), uint8_t(0), uint8_t(0))) +
         chunk("IDAT" + deflate(rows)) + chunk("IEND");
}

std::string bmp(int32_t width, int32_t height, const std::string& rows) {
  return "BM" +
         pack(uint32_t(54 + rows.size()), 0, 54, 40, width, height, uint16_t(1), uint16_t(24), 0,
              uint32_t(rows.size()), 2835, 2835, 0, 0) +
         rows;
}

std::string tga(uint16_t width, uint16_t height, int bits, const std::string& rows) {
  return std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + pack(width, height) +
         pack(uint8_t(bits), uint8_t(0x20 | (bits == 32 ? 8 : 0))) + rows;
}

std::string tiff(uint32_t width, uint32_t height, const std::string& pixels) {
  const auto entry = [](int tag, int type, uint32_t count, uint32_t value) {
    return pack(uint16_t(tag), uint16_t(type), count, value);
  };
  constexpr uint32_t kEntries = 9, kBits = 8 + 2 + kEntries * 12 + 4, kData = kBits + 6;
  return std::string("II*\0", 4) + pack(8u, uint16_t(kEntries)) + entry(256, 4, 1, width) +
         entry(257, 4, 1, height) + entry(258, 3, 3, kBits) + entry(259, 3, 1, 1) +
         entry(262, 3, 1, 2) + entry(273, 4, 1, kData) + entry(277, 3, 1, 3) +
         entry(278, 4, 1, height) + entry(279, 4, 1, uint32_t(pixels.size())) + pack(0u) +
         pack(uint16_t(8), uint16_t(8), uint16_t(8)) + pixels;
}

std::string hdr(int width, int height, const std::string& rgbe) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n" + rgbe;
}

bool is_read_as_by_the_module(const std::optional<ImageFile>& read, const char* kind,
                              const std::vector<uint8_t>& file) {
  if (!read) return false;
  const ImageFile other = decode_with_module(kind, file);
  return read->bytes == other.bytes && read->image.width == other.image.width &&
         read->image.height == other.image.height && read->image.channels == other.image.channels &&
         read->image.data == other.image.data && read->display_encoded == other.display_encoded &&
         read->display_size.x == other.display_size.x &&
         read->display_size.y == other.display_size.y;
}

}  // namespace duet::test
