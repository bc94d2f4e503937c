// Reads and writes image files: the only place that knows OpenEXR and OpenImageIO.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "image/film.h"
#include "image/image.h"

namespace duet {

/// A file's pixels as stored: nothing is decoded. 8- and 16-bit integers are scaled to [0, 1].
struct ImageFile {
  Image image;
  /// 8-bit integers as they are in the file, if it has them; then image.data is empty.
  std::vector<uint8_t> bytes;
  /// True for integer formats, whose values are meant for a display (sRGB) unless said otherwise.
  bool display_encoded = false;
  /// Position of the pixels within the display window, for crops.
  Point2i origin{0, 0};
  Point2i display_size{0, 0};
  /// Header fields that are text or numbers, as text.
  std::vector<std::pair<std::string, std::string>> header;
};

/// Throws ReadError if the file is missing, truncated or of a kind that is not understood. EXR
/// files with several parts or layers: channels keep their full names ("layer.R").
ImageFile read_image(const std::string& path);

using HeaderValue = std::variant<std::string, float, int, std::array<float, 16>>;

struct ExrOptions {
  bool half = true;
  /// Where the image lies within the full one.
  Point2i origin{0, 0};
  Point2i full_size{0, 0};
  float pixel_aspect = 1;
  std::vector<std::pair<std::string, HeaderValue>> header;
};

/// Writes under a temporary name in the same directory and renames: there is never half a file.
/// Throws std::runtime_error with the reason if the file cannot be written.
void write_exr(const std::string& path, const Image& image, const ExrOptions& options);
/// PNG or JPEG, by the extension. `bytes` has width × height × channels display values.
void write_display_image(const std::string& path, int width, int height, int channels,
                         const std::vector<uint8_t>& bytes);

}  // namespace duet
