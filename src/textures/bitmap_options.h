// How an image is read and looked up as a texture.
#pragma once

#include <optional>

#include "math/color_matrix.h"

namespace duet {

enum class TextureFilter { nearest, bilinear };
/// What lies outside the unit square. `zero` and `one` exist in Mitsuba 0.x only.
enum class WrapMode { repeat, mirror, clamp, zero, one };
/// Which channel of the file is used as a number.
/// `number`: as pbrt-v4 does, the mean of the colours, or the alpha of an image that is not opaque.
enum class TextureChannel { all, red, green, blue, alpha, number };

/// How the numbers in an image file become linear ones.
struct BitmapDecoding {
  /// Values are data: nothing is decoded.
  bool raw = false;
  /// Overrides the file's transfer curve: 1 is linear, −1 sRGB, another number a power.
  std::optional<double> gamma = std::nullopt;
  TextureChannel channel = TextureChannel::all;
  /// Multiplies what was decoded, if it has colours, into another colour space; what lies outside
  /// of that is moved to its edge: negative numbers become zero.
  std::optional<ColorMatrix> colors = std::nullopt;
  /// At last, values above one become one and negative ones zero.
  bool clamped = false;
  auto operator<=>(const BitmapDecoding&) const = default;
};

}  // namespace duet
