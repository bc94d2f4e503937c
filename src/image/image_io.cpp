#include "image/image_io.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "base/file_names.h"
#include "base/system/atomic_file.h"
#include "base/system/files.h"
#include "image/codecs.h"
#include "image/display_writers.h"
#include "image/exr_io.h"
#include "image/plain_jpeg.h"
#include "image/plain_png.h"

namespace duet {

namespace {

std::vector<uint8_t> read_bytes(const std::string& path) {
  const InputFile file(path);
  try {
    std::vector<uint8_t> bytes(size_t(file.size()));
    if (std::fread(bytes.data(), 1, bytes.size(), file.stream()) != bytes.size())
      throw ReadError(path + ": cannot be read");
    return bytes;
  } catch (const std::bad_alloc&) {
    throw ReadError(path + ": is too large for the memory");
  }
}

/// The kind of file by its first bytes, as codec_module.h names it; null if unknown.
const char* kind_of(const std::vector<uint8_t>& bytes, const std::string& path) {
  struct Mark {
    std::string_view bytes;
    const char* kind;
  };
  static constexpr Mark kMarks[] = {
      {"\x89PNG\r\n\x1a\n", "png"},
      {"\xff\xd8\xff", "jpeg"},
      {"BM", "bmp"},
      {"#?", "hdr"},
      {{"II*\0", 4}, "tiff"},
      {{"MM\0*", 4}, "tiff"},
      {{"II+\0", 4}, "tiff"},
      {{"MM\0+", 4}, "tiff"},
      {"P1", "pnm"},
      {"P2", "pnm"},
      {"P3", "pnm"},
      {"P4", "pnm"},
      {"P5", "pnm"},
      {"P6", "pnm"},
      {"Pf", "pnm"},
      {"PF", "pnm"},
  };
  const std::string_view begin(reinterpret_cast<const char*>(bytes.data()),
                               std::min<size_t>(bytes.size(), 16));
  for (const Mark& mark : kMarks)
    if (begin.substr(0, mark.bytes.size()) == mark.bytes) return mark.kind;
  return extension_of(path) == ".tga" ? "targa" : nullptr;
}

/// True if the scan data of a JPEG file go on to its end marker. libjpeg fills what is missing with
/// grey and reports nothing.
bool is_complete_jpeg(const std::vector<uint8_t>& bytes) {
  constexpr uint8_t kStart = 0xd8, kEnd = 0xd9, kScan = 0xda, kRestart0 = 0xd0, kRestart7 = 0xd7;
  size_t i = 2;
  while (i + 4 <= bytes.size()) {
    if (bytes[i] != 0xff) {
      ++i;  // between segments anything may stand
      continue;
    }
    const uint8_t marker = bytes[i + 1];
    if (marker == kEnd) return true;
    if (marker == 0xff || marker == 0 || marker == kStart ||
        (marker >= kRestart0 && marker <= kRestart7)) {
      i += marker == 0xff ? 1 : 2;
      continue;
    }
    i += 2 + (size_t(bytes[i + 2]) << 8 | bytes[i + 3]);
    if (marker != kScan) continue;
    // Within the scan, 0xff stands before a zero, a restart marker, or the next segment.
    while (i + 1 < bytes.size() && (bytes[i] != 0xff || bytes[i + 1] == 0 ||
                                    (bytes[i + 1] >= kRestart0 && bytes[i + 1] <= kRestart7)))
      ++i;
  }
  return i + 2 <= bytes.size() && bytes[i] == 0xff && bytes[i + 1] == kEnd;
}

/// What `encode` returns; what it throws becomes a runtime_error that names the file.
template <class Encode>
std::vector<uint8_t> encoded(const std::string& path, Encode encode) {
  try {
    return encode();
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format("{} cannot be written: {}", path, e.what()));
  }
}

}  // namespace

ImageFile unnamed_image(int width, int height, int channels) {
  static const std::vector<std::string> kNames[] = {
      {}, {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  ImageFile file;
  file.display_size = {width, height};
  file.image.width = width;
  file.image.height = height;
  file.image.channels = kNames[std::min(channels, 4)];
  for (int c = 4; c < channels; ++c) file.image.channels.push_back(fmt::format("channel{}", c));
  return file;
}

ImageFile read_image(const std::string& path) {
  const std::vector<uint8_t> bytes = read_bytes(path);
  if (bytes.empty()) throw ReadError(path + ": is empty");
  if (is_exr(bytes)) return decode_exr(path, bytes);
  const char* kind = kind_of(bytes, path);
  if (!kind)
    throw ReadError(
        path + ": is not an image of a known kind (EXR, PNG, JPEG, BMP, TGA, HDR, TIFF, PFM, PNM)");
  if (kind == std::string_view("jpeg") && !is_complete_jpeg(bytes))
    throw ReadError(path + ": the file ends in the middle of the image");
  try {
    if (kind == std::string_view("png"))
      if (std::optional<ImageFile> file = read_plain_png(bytes)) return std::move(*file);
    if (kind == std::string_view("jpeg"))
      if (std::optional<ImageFile> file = read_plain_jpeg(bytes)) return std::move(*file);
    return decode_with_module(kind, bytes);
  } catch (const std::bad_alloc&) {
    throw ReadError(path + ": is too large for the memory");
  } catch (const std::exception& e) {
    throw ReadError(fmt::format("{}: {}", path, e.what()));
  }
}

std::vector<uint8_t> exr_bytes(const std::string& path, const Image& image,
                               const ExrOptions& options) {
  return encoded(path, [&] { return encode_exr(image, options); });
}

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
  write_file_atomically(path, exr_bytes(path, image, options));
}

template <class Value>
std::vector<uint8_t> display_image_bytes(const std::string& path, int width, int height,
                                         int channels, const std::vector<Value>& values,
                                         const TextFields& fields) {
  constexpr int kBits = std::numeric_limits<Value>::digits;
  const std::string extension = extension_of(path);
  const bool png = extension == ".png", jpeg = extension == ".jpg" || extension == ".jpeg";
  if (!png && !jpeg)
    throw std::runtime_error(
        fmt::format("{} cannot be written: only .png and .jpg are display images", path));
  if (width <= 0 || height <= 0 || channels < 1 || channels > 4 ||
      values.size() != size_t(width) * size_t(height) * size_t(channels))
    throw std::invalid_argument("write_display_image: size and data do not match");
  if (jpeg && std::max(width, height) > kGreatestJpegSide)
    throw std::runtime_error(fmt::format("{} cannot be written: JPEG has at most {} pixels a side",
                                         path, kGreatestJpegSide));
  if (jpeg && (channels == 2 || channels == 4))
    throw std::runtime_error(fmt::format("{} cannot be written: JPEG has no alpha", path));
  if (jpeg && kBits != 8)
    throw std::runtime_error(fmt::format("{} cannot be written: JPEG has 8 bits", path));
  const DisplayPixels pixels{width, height, channels, kBits, values.data()};
  std::vector<uint8_t> file =
      encoded(path, [&] { return png ? encode_png(pixels) : encode_jpeg(pixels); });
  png ? add_png_text(file, fields) : add_jpeg_comment(file, fields);
  return file;
}

template std::vector<uint8_t> display_image_bytes(const std::string&, int, int, int,
                                                  const std::vector<uint8_t>&, const TextFields&);
template std::vector<uint8_t> display_image_bytes(const std::string&, int, int, int,
                                                  const std::vector<uint16_t>&, const TextFields&);

void check_display_image(const std::string& path, int width, int height) {
  // The longest side in one row has the limits of the format, and a row is soon made.
  const int side = std::max(width, height);
  display_image_bytes(path, side, 1, 1, std::vector<uint8_t>(size_t(side)));
}

void write_display_image(const std::string& path, int width, int height, int channels,
                         const std::vector<uint8_t>& bytes, const TextFields& fields) {
  write_file_atomically(path, display_image_bytes(path, width, height, channels, bytes, fields));
}

}  // namespace duet
