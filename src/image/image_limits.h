// Which images are too large to be believed.
#pragma once

#include <cstdint>

namespace duet {

/// The greatest width and height that are read.
inline constexpr int kGreatestImageSize = 1 << 17;

/// False if a file of `file_bytes` cannot sensibly hold pixels that take up `image_bytes`: DEFLATE
/// packs at most 1032 bytes into one, and what any compression makes of small files is allowed
/// for. A damaged header thus costs no memory.
constexpr bool is_plausible_size(uint64_t image_bytes, uint64_t file_bytes) {
  constexpr uint64_t kAlwaysAllowed = uint64_t(256) << 20;
  return image_bytes <= kAlwaysAllowed || image_bytes / 1032 <= file_bytes;
}

/// Whether an image of this size, whose pixels take up `image_bytes`, is read.
constexpr bool is_readable_size(uint64_t width, uint64_t height, uint64_t image_bytes,
                                uint64_t file_bytes) {
  return width <= uint64_t(kGreatestImageSize) && height <= uint64_t(kGreatestImageSize) &&
         is_plausible_size(image_bytes, file_bytes);
}

}  // namespace duet
