#include "textures/bitmap_pixels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/diagnostics.h"

namespace duet {

float decode_gamma(float value, double gamma) {
  if (gamma == 1) return value;
  if (gamma == -1) return srgb_to_linear(value);
  return value > 0 ? std::pow(value, float(gamma)) : 0.0f;
}

double transfer_curve(const ImageFile& file, const std::optional<double>& gamma) {
  return gamma ? *gamma : file.display_encoded ? -1.0 : 1.0;
}

BitmapPixels::BitmapPixels(int width, int height, int channels, std::vector<float> values)
    : BitmapPixels(width, height, channels) {
  assert(width > 0 && height > 0 && (channels == 1 || channels == 3));
  assert(values.size() == size_t(width) * size_t(height) * size_t(channels));
  keep(std::move(values));
}

bool BitmapPixels::keep_halves(const std::vector<float>& values) {
  const size_t n = size_t(channels_), stride = is_grey() ? 1 : kColorStride;
  // Most images that are no halves show it soon.
  std::vector<uint16_t> halves;
  halves.reserve(values.size() / n * stride);
  for (size_t i = 0; i < values.size(); ++i) {
    const uint16_t bits = half_bits(values[i]);
    if (half_value(bits) != values[i]) return false;
    halves.push_back(bits);
    if (i % n + 1 == n) halves.resize(halves.size() + stride - n);
  }
  halves_ = std::move(halves);
  return true;
}

void BitmapPixels::keep(std::vector<float> values) {
  if (keep_halves(values)) {
    type_ = TexelType::half;
    values = {};
  }
  floats_ = std::move(values);
  measure();
}

void BitmapPixels::measure() {
  double sum[3] = {0, 0, 0};
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Spectrum c = color(x, y);
      for (int k = 0; k < 3; ++k) sum[k] += c[k];
    }
  const double n = double(width_) * height_;
  average_ = {float(sum[0] / n), float(sum[1] / n), float(sum[2] / n)};
}

namespace {

bool is_opaque(const ImageFile& file, size_t alpha) {
  const size_t stride = file.image.channels.size();
  for (size_t i = alpha; i < file.bytes.size(); i += stride)
    if (file.bytes[i] != 255) return false;
  for (size_t i = alpha; i < file.image.data.size(); i += stride)
    if (file.image.data[i] != 1) return false;
  return true;
}

/// Which of the file's channels make the texture's one or three.
std::vector<int> choose_channels(const ImageFile& file, TextureChannel channel) {
  const Image& image = file.image;
  const int r = image.find_channel("R"), g = image.find_channel("G"), b = image.find_channel("B"),
            a = image.find_channel("A");
  const bool colored = r >= 0 && g >= 0 && b >= 0;
  int grey = image.find_channel("Y");
  if (grey < 0 && (image.channel_count() == 1 || (image.channel_count() == 2 && a == 1))) grey = 0;
  if (channel == TextureChannel::alpha) {
    if (a < 0) throw ReadError("the image has no alpha channel");
    return {a};
  }
  if (!colored && grey < 0) {
    std::string names;
    for (const std::string& name : image.channels) names += (names.empty() ? "" : ", ") + name;
    throw ReadError("the image has neither R, G and B nor a single channel, but " + names);
  }
  if (!colored) return {grey};
  if (channel == TextureChannel::number && a >= 0 && !is_opaque(file, size_t(a))) return {a};
  switch (channel) {
    case TextureChannel::red:
      return {r};
    case TextureChannel::green:
      return {g};
    case TextureChannel::blue:
      return {b};
    default:
      return {r, g, b};
  }
}

/// The chosen channels of pixels of `stride` numbers, `room` numbers for each texel.
template <class T>
std::vector<T> gather(const std::vector<T>& pixels, size_t stride, const std::vector<int>& chosen,
                      size_t room) {
  const size_t texels = pixels.size() / stride;
  std::vector<T> out(texels * room);
  for (size_t i = 0; i < texels; ++i)
    for (size_t c = 0; c < chosen.size(); ++c)
      out[i * room + c] = pixels[i * stride + size_t(chosen[c])];
  return out;
}

/// Returns how many numbers it has replaced.
size_t remove_nonfinite(std::vector<float>& values) {
  constexpr float kLargestHalf = 65504;
  size_t count = 0;
  for (float& v : values)
    if (!std::isfinite(v)) {
      v = std::isnan(v) ? 0.0f : std::copysign(kLargestHalf, v);
      ++count;
    }
  return count;
}

bool keeps_grey(const ColorMatrix& m) {
  return std::all_of(m.begin(), m.end(),
                     [](const auto& row) { return std::abs(row[0] + row[1] + row[2] - 1) < 1e-6; });
}

void convert(std::vector<float>& colors, const ColorMatrix& matrix) {
  for (size_t i = 0; i < colors.size(); i += 3) {
    const Spectrum c = matrix * Spectrum(colors[i], colors[i + 1], colors[i + 2]);
    for (int k = 0; k < 3; ++k) colors[i + size_t(k)] = std::max(c[k], 0.0f);
  }
}

}  // namespace

BitmapPixels BitmapPixels::from_file(ImageFile file, const BitmapDecoding& decoding) {
  std::vector<int> chosen = choose_channels(file, decoding.channel);
  // Opacity is a share, not a colour.
  const bool data =
      decoding.raw || (chosen.size() == 1 && chosen[0] == file.image.find_channel("A"));
  const double gamma = data ? 1.0 : transfer_curve(file, decoding.gamma);
  // Light that is white in one space may have a colour in another.
  if (decoding.channel == TextureChannel::all && chosen.size() == 1 && decoding.colors &&
      !keeps_grey(*decoding.colors))
    chosen.resize(3, chosen[0]);
  const bool converts = decoding.colors && chosen.size() == 3;
  const bool mean = decoding.channel == TextureChannel::number && chosen.size() == 3;
  const size_t n = chosen.size(), stride = file.image.channels.size();
  BitmapPixels pixels(file.image.width, file.image.height, mean ? 1 : int(n));
  std::vector<float> values;
  if (!file.bytes.empty()) {
    for (int i = 0; i < 256; ++i) pixels.table_[size_t(i)] = decode_gamma(float(i) / 255.0f, gamma);
    if (!mean && !converts) {
      pixels.type_ = TexelType::byte;
      pixels.bytes_ = gather(file.bytes, stride, chosen, n == 1 ? 1 : kColorStride);
      pixels.measure();
      return pixels;
    }
    const std::vector<uint8_t> bytes = gather(file.bytes, stride, chosen, n);
    values.reserve(bytes.size());
    for (const uint8_t byte : bytes) values.push_back(pixels.table_[byte]);
  } else {
    values = gather(file.image.data, stride, chosen, n);
    file = {};  // large images are not kept twice
    pixels.replaced_ = remove_nonfinite(values);
    if (gamma != 1)
      for (float& v : values) v = decode_gamma(v, gamma);
  }
  if (converts) convert(values, *decoding.colors);
  if (decoding.clamped)
    for (float& v : values) v = std::clamp(v, 0.0f, 1.0f);
  if (mean) {
    for (size_t i = 0; i < values.size() / 3; ++i)
      values[i] = (values[3 * i] + values[3 * i + 1] + values[3 * i + 2]) / 3;
    values.resize(values.size() / 3);
  }
  pixels.keep(std::move(values));
  return pixels;
}

}  // namespace duet
