// Reads and writes image files: the only place that knows OpenEXR and OpenImageIO.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "image/image.h"
#include "image/text_fields.h"
#include "math/vector.h"

namespace duet {

/// A file's pixels as stored: nothing is decoded, alpha is not multiplied in.
struct ImageFile {
  /// Channels are R, G, B, then A, or Y (and A) for grey; in EXR files they keep their names, each
  /// layer in that order. 16-bit integers are scaled to [0, 1].
  Image image;
  /// 8-bit integers as they are in the file, if it has them; then image.data is empty.
  std::vector<uint8_t> bytes;
  /// True for integer formats, whose values are meant for a display (sRGB) unless said otherwise.
  bool display_encoded = false;
  /// Position of the pixels within the display window, for crops.
  Point2i origin{0, 0};
  Point2i display_size{0, 0};
  /// Header fields of EXR files that are text or numbers, as text.
  std::vector<std::pair<std::string, std::string>> header;
};

/// An image of a format that has no names for its channels, still without pixels.
ImageFile unnamed_image(int width, int height, int channels);

/// Reads OpenEXR, PNG, JPEG, BMP, TGA, Radiance HDR, TIFF, PFM and PNM files, told apart by their
/// contents (TGA, which has no mark, by its extension). Throws ReadError if the file is missing,
/// damaged or of a kind that is not understood: deep and subsampled EXR files are not. Of EXR files
/// with several parts, the channels of the first keep their names and those of the others are
/// "part.R", whether the file says it or not.
ImageFile read_image(const std::string& path);

/// Text, numbers, or a 4×4 matrix for row vectors.
using HeaderValue = std::variant<std::string, float, int, std::array<float, 16>>;

struct ExrOptions {
  /// 16-bit floats: values beyond ±65504 are stored as that, unless they are infinite.
  bool half = true;
  /// Channels that are 32-bit floats nevertheless.
  std::vector<std::string> full_precision;
  /// Where the image lies within the full one; a size of zero means the image is the full one.
  Point2i origin{0, 0};
  Point2i full_size{0, 0};
  float pixel_aspect = 1;
  /// Whether each layer is a part of its own, with the layer's name (channel_names.h).
  bool parts = false;
  std::vector<std::pair<std::string, HeaderValue>> header;
};

/// An OpenEXR file with ZIP-compressed scan lines. Equal images and options give equal bytes.
/// Throws std::runtime_error, which names `path`.
std::vector<uint8_t> exr_bytes(const std::string& path, const Image& image,
                               const ExrOptions& options);
/// A PNG or JPEG file (quality 95, all chroma samples), by the extension. `values` are
/// width × height × channels sRGB values, uint8_t or, for PNG, uint16_t, from 0 to the greatest of
/// the type; 1 channel is grey, 3 are colours, and PNG takes an alpha that is not multiplied in as
/// channel 2 or 4. `fields` become text chunks or the comment (text_fields.h). Throws
/// std::runtime_error, which names `path`.
template <class Value>
std::vector<uint8_t> display_image_bytes(const std::string& path, int width, int height,
                                         int channels, const std::vector<Value>& values,
                                         const TextFields& fields = {});

/// Throws what it would throw of any image of this size: asked before there are pixels.
void check_display_image(const std::string& path, int width, int height);

/// Write such files. The file is replaced as a whole (see base/atomic_file.h). Throw
/// std::runtime_error with the reason if it cannot be written.
void write_exr(const std::string& path, const Image& image, const ExrOptions& options);
void write_display_image(const std::string& path, int width, int height, int channels,
                         const std::vector<uint8_t>& bytes, const TextFields& fields = {});

}  // namespace duet
