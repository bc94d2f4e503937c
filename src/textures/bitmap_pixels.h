// The pixels of an image as textures read them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "image/image_io.h"
#include "textures/bitmap_options.h"

namespace duet {

/// One or three channels of linear values in rows from the top. 8-bit images stay bytes that a
/// table decodes at each lookup, everything else is single precision.
class BitmapPixels {
 public:
  /// `values` has width × height × channels linear values; one or three channels.
  BitmapPixels(int width, int height, int channels, std::vector<float> values);
  /// Bytes that mean what `table` says.
  BitmapPixels(int width, int height, int channels, const std::vector<uint8_t>& bytes,
               const std::array<float, 256>& table);
  /// From the pixels of a file; alpha is left out unless it is asked for. Throws ReadError if the
  /// file has not the channel asked for, or neither colours nor a single channel.
  static BitmapPixels from_file(const ImageFile& file, const BitmapDecoding& decoding);

  int width() const { return width_; }
  int height() const { return height_; }
  bool is_grey() const { return channels_ == 1; }
  Spectrum average() const { return average_; }

  /// Calls `f` with a function (x, y) → texel that knows how the pixels are stored.
  template <class F>
  float visit_grey(F&& f) const {
    const size_t w = size_t(width_);
    if (bytes_.empty())
      return f([w, p = floats_.data()](int x, int y) { return p[size_t(y) * w + size_t(x)]; });
    return f([w, p = bytes_.data(), t = table_.data()](int x, int y) {
      return t[p[size_t(y) * w + size_t(x)]];
    });
  }
  template <class F>
  Spectrum visit_color(F&& f) const {
    const size_t w = size_t(width_);
    if (bytes_.empty())
      return f([w, p = floats_.data()](int x, int y) {
        const float* c = p + 3 * (size_t(y) * w + size_t(x));
        return Spectrum(c[0], c[1], c[2]);
      });
    return f([w, p = bytes_.data(), t = table_.data()](int x, int y) {
      const uint8_t* c = p + kColorStride * (size_t(y) * w + size_t(x));
      return Spectrum(t[c[0]], t[c[1]], t[c[2]]);
    });
  }
  /// The texel (x, y), which must exist.
  Spectrum color(int x, int y) const {
    const auto texel = [&](const auto& t) { return t(x, y); };
    return is_grey() ? Spectrum(visit_grey(texel)) : visit_color(texel);
  }
  /// Its luminance.
  float value(int x, int y) const {
    const auto texel = [&](const auto& t) { return t(x, y); };
    return is_grey() ? visit_grey(texel) : visit_color(texel).luminance();
  }
  /// Tells the processor that the texel (x, y), which must exist, will be asked for.
  void prefetch(int x, int y) const {
    const size_t at = size_t(y) * size_t(width_) + size_t(x);
    if (bytes_.empty())
      __builtin_prefetch(&floats_[at * size_t(channels_)]);
    else
      __builtin_prefetch(&bytes_[at * (is_grey() ? 1 : kColorStride)]);
  }

 private:
  /// Bytes per texel of a colour image: with a fourth one no texel straddles two cache lines.
  static constexpr size_t kColorStride = 4;
  void measure();

  int width_, height_, channels_;
  std::vector<uint8_t> bytes_;
  std::vector<float> floats_;
  std::array<float, 256> table_{};
  Spectrum average_;
};

/// The linear value of a number under a transfer curve: 1 is linear, −1 sRGB, another number a
/// power.
float decode_gamma(float value, double gamma);

/// The curve of a file's values: what `gamma` says, else sRGB for integer formats, linear for
/// others.
double transfer_curve(const ImageFile& file, const std::optional<double>& gamma);

/// Replaces what is not finite in a file's floating-point values: NaN by zero, infinities by the
/// largest half-precision number. Returns how many values that were.
size_t remove_nonfinite(std::vector<float>& values);

}  // namespace duet
