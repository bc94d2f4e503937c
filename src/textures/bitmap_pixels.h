// The pixels of an image as textures read them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "image/half.h"
#include "image/image_io.h"
#include "textures/bitmap_options.h"

namespace duet {

/// How texels are kept. Bytes mean what a table says at each lookup.
enum class TexelType { byte, half, single };

/// One or three channels of linear values in rows from the top. Images stay as small as their files
/// have them: 8-bit integers stay bytes, and values that 16-bit floats hold exactly become such;
/// everything else is single precision.
class BitmapPixels {
 public:
  /// `values` has width × height × channels linear values; one or three channels.
  BitmapPixels(int width, int height, int channels, std::vector<float> values);
  /// From the pixels of a file; alpha is left out unless it is asked for. Numbers that are not
  /// finite are replaced: NaN by zero, infinities by the largest half-precision number. Throws
  /// ReadError if the file has not the channel asked for, or neither colours nor a single channel.
  static BitmapPixels from_file(ImageFile file, const BitmapDecoding& decoding);

  int width() const { return width_; }
  int height() const { return height_; }
  bool is_grey() const { return channels_ == 1; }
  Spectrum average() const { return average_; }
  TexelType type() const { return type_; }
  /// How many numbers of the file were replaced because they were not finite.
  size_t replaced() const { return replaced_; }
  /// Bytes that a texel takes in memory. With a fourth channel no texel of bytes or halves
  /// straddles two cache lines.
  static constexpr size_t texel_bytes(TexelType type, int channels) {
    if (type == TexelType::single) return sizeof(float) * size_t(channels);
    const size_t each = type == TexelType::half ? sizeof(uint16_t) : 1;
    return channels == 1 ? each : kColorStride * each;
  }

  /// Calls `f` with a function (x, y) → texel that knows how the pixels are stored.
  template <class F>
  float visit_grey(F&& f) const {
    return visit<float>([&](const auto* numbers, const auto& decode) {
      return f(GreyTexels{numbers, size_t(width_), decode});
    });
  }
  template <class F>
  Spectrum visit_color(F&& f) const {
    return visit<Spectrum>([&](const auto* numbers, const auto& decode) {
      return f(ColorTexels{numbers, size_t(width_), decode});
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
  /// Tells the processor that the texel (x, y), which must exist, will be asked for. (g++ 12 drops
  /// calls of functions that do nothing else.)
  [[gnu::always_inline]] void prefetch(int x, int y) const {
    const size_t at = size_t(y) * size_t(width_) + size_t(x), stride = is_grey() ? 1 : kColorStride;
    if (type_ == TexelType::byte)
      __builtin_prefetch(&bytes_[at * stride]);
    else if (type_ == TexelType::half)
      __builtin_prefetch(&halves_[at * stride]);
    else
      __builtin_prefetch(&floats_[at * size_t(channels_)]);
  }

 private:
  /// Numbers per texel of a colour image of bytes or halves.
  static constexpr size_t kColorStride = 4;

  // Four texels are read for each lookup: calls would take longer than the reading.
  template <class Number, class Decode>
  struct GreyTexels {
    const Number* numbers;
    size_t width;
    Decode decode;
    [[gnu::always_inline]] float operator()(int x, int y) const {
      return decode(numbers[size_t(y) * width + size_t(x)]);
    }
  };
  // Compilers older than C++20's rules for aggregates need the guides.
  template <class Number, class Decode>
  GreyTexels(const Number*, size_t, Decode) -> GreyTexels<Number, Decode>;
  template <class Number, class Decode>
  struct ColorTexels {
    const Number* numbers;
    size_t width;
    Decode decode;
    [[gnu::always_inline]] Spectrum operator()(int x, int y) const {
      constexpr size_t kStride = std::is_same_v<Number, float> ? 3 : kColorStride;
      const Number* c = numbers + kStride * (size_t(y) * width + size_t(x));
      return Spectrum(decode(c[0]), decode(c[1]), decode(c[2]));
    }
  };
  template <class Number, class Decode>
  ColorTexels(const Number*, size_t, Decode) -> ColorTexels<Number, Decode>;
  /// Calls `f` with what is stored and a function that makes linear values of it.
  template <class Result, class F>
  Result visit(const F& f) const {
    if (type_ == TexelType::byte)
      return f(bytes_.data(), [table = table_.data()](uint8_t byte) { return table[byte]; });
    if (type_ == TexelType::half)
      return f(halves_.data(), [](uint16_t bits) { return half_value(bits); });
    return f(floats_.data(), [](float value) { return value; });
  }

  BitmapPixels(int width, int height, int channels)
      : width_(width), height_(height), channels_(channels) {}
  /// Keeps `values` as 16-bit floats if those hold all of them.
  void keep(std::vector<float> values);
  bool keep_halves(const std::vector<float>& values);
  void measure();

  int width_, height_, channels_;
  TexelType type_ = TexelType::single;
  std::vector<uint8_t> bytes_;
  std::vector<uint16_t> halves_;
  std::vector<float> floats_;
  std::array<float, 256> table_{};
  Spectrum average_;
  size_t replaced_ = 0;
};

/// The linear value of a number under a transfer curve: 1 is linear, −1 sRGB, another number a
/// power.
float decode_gamma(float value, double gamma);

/// The curve of a file's values: what `gamma` says, else sRGB for integer formats, linear for
/// others.
double transfer_curve(const ImageFile& file, const std::optional<double>& gamma);

}  // namespace duet
