#include "image/text_fields.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "image/jpeg_segments.h"

namespace duet {

namespace {

// ---- PNG --------------------------------------------------------------------------------------

constexpr size_t kPngMark = 8;
/// The mark and the first chunk, IHDR, which has 13 bytes.
constexpr size_t kPngHead = kPngMark + 12 + 13;
/// Longer text chunks are none of ours.
constexpr uint32_t kLongestText = 1 << 20;

/// Source: PNG (Third Edition), annex D: the polynomial of ISO 3309.
uint32_t crc(std::string_view bytes) {
  uint32_t c = 0xffffffffu;
  for (const char byte : bytes) {
    c ^= uint8_t(byte);
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

std::string big_endian(uint32_t v) {
  return {char(v >> 24), char(v >> 16), char(v >> 8), char(v)};
}
uint32_t from_big_endian(const uint8_t* p) {
  return uint32_t(p[0]) << 24 | uint32_t(p[1]) << 16 | uint32_t(p[2]) << 8 | p[3];
}

std::string png_chunk(const std::string& name, const std::string& value) {
  const bool ascii =
      std::all_of(value.begin(), value.end(), [](char c) { return uint8_t(c) < 0x80; });
  const std::string zero(1, '\0');
  // iTXt: not compressed (two zeros), no language, no translation of the name.
  const std::string body =
      ascii ? "tEXt" + name + zero + value : "iTXt" + name + zero + std::string(4, '\0') + value;
  return big_endian(uint32_t(body.size() - 4)) + body + big_endian(crc(body));
}

/// The field of a text chunk's data; an empty name if it is compressed or damaged.
std::pair<std::string, std::string> png_field(std::string_view type, const std::string& data) {
  const size_t zero = data.find('\0');
  if (zero == std::string::npos) return {};
  const std::string name = data.substr(0, zero);
  if (type == "tEXt") return {name, data.substr(zero + 1)};
  if (zero + 2 >= data.size() || data[zero + 1] != 0) return {};
  const size_t language = data.find('\0', zero + 3);
  if (language == std::string::npos) return {};
  const size_t translation = data.find('\0', language + 1);
  if (translation == std::string::npos) return {};
  return {name, data.substr(translation + 1)};
}

// ---- JPEG -------------------------------------------------------------------------------------

constexpr uint8_t kComment = 0xfe, kEnd = 0xd9;
constexpr size_t kLongestComment = 65533;

bool is_application_marker(uint8_t marker) {
  return marker >= 0xe0 && marker <= 0xef;
}

template <size_t n>
bool read(std::FILE* file, std::array<uint8_t, n>& bytes) {
  return std::fread(bytes.data(), 1, n, file) == n;
}

bool read(std::FILE* file, std::string& bytes) {
  return std::fread(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

}  // namespace

void add_png_text(std::vector<uint8_t>& png, const TextFields& fields) {
  std::string chunks;
  for (const auto& [name, value] : fields) chunks += png_chunk(name, value);
  png.insert(png.begin() + kPngHead, chunks.begin(), chunks.end());
}

TextFieldsFound find_png_text(std::FILE* file) {
  TextFieldsFound found;
  if (std::fseek(file, kPngMark, SEEK_SET) != 0) return found;
  std::array<uint8_t, 8> head;
  while (read(file, head)) {
    const uint32_t length = from_big_endian(head.data());
    const std::string type(head.begin() + 4, head.end());
    std::array<uint8_t, 4> check;
    if ((type == "tEXt" || type == "iTXt") && length <= kLongestText) {
      std::string data(length, '\0');
      if (!read(file, data)) break;
      if (auto field = png_field(type, data); !field.first.empty())
        found.fields.push_back(std::move(field));
    } else if (std::fseek(file, long(length), SEEK_CUR) != 0) {
      break;
    }
    if (!read(file, check)) break;
    if (type == "IEND") {
      found.is_complete = true;
      break;
    }
  }
  return found;
}

void add_jpeg_comment(std::vector<uint8_t>& jpeg, const TextFields& fields) {
  std::string text;
  for (const auto& [name, value] : fields) {
    std::string line = name + ": " + value;
    std::replace(line.begin(), line.end(), '\n', ' ');
    text += line + "\n";
  }
  std::string segments;
  for (size_t at = 0; at < text.size(); at += kLongestComment) {
    const std::string part = text.substr(at, kLongestComment);
    const size_t length = part.size() + 2;
    segments += {'\xff', char(kComment), char(length >> 8), char(length)};
    segments += part;
  }
  // After what says which kind of JPEG file it is.
  size_t at = 2;
  while (at + 4 <= jpeg.size() && jpeg[at] == 0xff && is_application_marker(jpeg[at + 1]))
    at += 2 + (size_t(jpeg[at + 2]) << 8 | jpeg[at + 3]);
  jpeg.insert(jpeg.begin() + std::ptrdiff_t(std::min(at, jpeg.size())), segments.begin(),
              segments.end());
}

TextFieldsFound find_jpeg_comment(std::FILE* file) {
  TextFieldsFound found;
  std::string text;
  visit_jpeg_segments(file, [&](uint8_t marker, size_t length) {
    if (marker != kComment) return true;
    std::string part(length, '\0');
    if (!read(file, part)) return false;
    text += part;
    return true;
  });
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (const size_t colon = line.find(": "); colon != std::string::npos)
      found.fields.emplace_back(line.substr(0, colon), line.substr(colon + 2));
    at = end + 1;
  }
  // Within the scan a marker of the end cannot occur.
  std::array<uint8_t, 2> last;
  found.is_complete =
      std::fseek(file, -2, SEEK_END) == 0 && read(file, last) && last[0] == 0xff && last[1] == kEnd;
  return found;
}

}  // namespace duet
