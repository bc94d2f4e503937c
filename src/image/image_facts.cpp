#include "image/image_facts.h"

#include <array>
#include <cstdio>
#include <string_view>

#include "base/diagnostics.h"
#include "base/system/files.h"
#include "image/exr_io.h"
#include "image/jpeg_segments.h"
#include "image/text_fields.h"

namespace duet {

std::string ImageFacts::field(const std::string& name) const {
  for (const auto& [key, value] : fields)
    if (key == name) return value;
  return "";
}

namespace {

/// Source: PNG (Third Edition), section 11.2.1: IHDR is the first chunk.
void read_png_size(std::FILE* file, ImageFacts& facts) {
  std::array<uint8_t, 26> b;
  if (std::fseek(file, 0, SEEK_SET) != 0 || std::fread(b.data(), 1, b.size(), file) != b.size())
    return;
  const auto number = [&](size_t at) {
    return int(uint32_t(b[at]) << 24 | uint32_t(b[at + 1]) << 16 | uint32_t(b[at + 2]) << 8 |
               b[at + 3]);
  };
  const int depth = b[24], kind = b[25];
  constexpr int kColours = 2, kPalette = 1, kAlpha = 4;
  facts.width = number(16);
  facts.height = number(20);
  facts.channels = (kind & (kColours | kPalette) ? 3 : 1) + (kind & kAlpha ? 1 : 0);
  facts.numbers = depth == 16 ? StoredNumbers::others : StoredNumbers::bytes;
}

/// Source: ITU-T T.81, B.2.2: the header of a frame.
void read_jpeg_size(std::FILE* file, ImageFacts& facts) {
  visit_jpeg_segments(file, [&](uint8_t marker, size_t length) {
    constexpr uint8_t kHuffman = 0xc4, kExtension = 0xc8, kArithmetic = 0xcc;
    const bool is_frame = (marker & 0xf0) == 0xc0 && marker != kHuffman && marker != kExtension &&
                          marker != kArithmetic;
    std::array<uint8_t, 6> b;
    if (!is_frame || length < b.size()) return true;
    if (std::fread(b.data(), 1, b.size(), file) != b.size()) return false;
    facts.height = b[1] << 8 | b[2];
    facts.width = b[3] << 8 | b[4];
    facts.channels = b[5];
    facts.numbers = StoredNumbers::bytes;
    return false;
  });
}

}  // namespace

ImageFacts read_image_facts(const std::string& path) {
  const InputFile file(path);
  if (file.size() == 0) throw ReadError(path + ": is empty");
  std::vector<uint8_t> begin(8);
  begin.resize(std::fread(begin.data(), 1, begin.size(), file.stream()));
  const std::string_view mark(reinterpret_cast<const char*>(begin.data()), begin.size());
  if (is_exr(begin)) return exr_facts(path);
  ImageFacts facts;
  TextFieldsFound found;
  if (mark == "\x89PNG\r\n\x1a\n") {
    read_png_size(file.stream(), facts);
    found = find_png_text(file.stream());
  } else if (mark.starts_with("\xff\xd8\xff")) {
    read_jpeg_size(file.stream(), facts);
    found = find_jpeg_comment(file.stream());
  } else {
    throw ReadError(path + ": is not an EXR, PNG or JPEG image");
  }
  facts.fields = std::move(found.fields);
  facts.is_complete = found.is_complete;
  return facts;
}

}  // namespace duet
