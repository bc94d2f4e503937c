// The film: gathers weighted samples into pixels, tile by tile.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "image/filter.h"
#include "image/image.h"
#include "math/spectrum.h"
#include "math/vector.h"

namespace duet {

/// A rectangle of whole pixels; `x1` and `y1` are one past the end.
struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  bool operator==(const PixelBounds&) const = default;
  PixelBounds intersect(const PixelBounds& o) const;
  PixelBounds grow(int border) const {
    return {x0 - border, y0 - border, x1 + border, y1 + border};
  }
};

/// What a film makes of linear sRGB: exposure, white balance, the primaries of its colour space.
using FilmResponse = std::array<std::array<double, 3>, 3>;

/// What a single sample may bring. Where the largest of the three values that `sensor` makes of its
/// colour is above `most`, the colour is scaled down to that: noise turns into bias.
struct SampleLimit {
  FilmResponse sensor{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double most = 1;
  bool operator==(const SampleLimit&) const = default;

  /// What the colour R, G and B is to be multiplied by.
  float share(const float* rgb) const;
};

/// The sums of the samples taken in one square of the film. A sample also counts for pixels beyond
/// the square, as far as the filter reaches; tiles keep those sums apart, so that threads share
/// nothing and the film adds them in the same order whatever ran when. Sums are of doubles, sample
/// by sample: a constant stays one however many samples it has.
class FilmTile {
 public:
  /// `sampled` are the pixels in which samples are taken, `stored` those they may count for. A
  /// limit is that of the first three channels.
  FilmTile(const PixelBounds& sampled, const PixelBounds& stored, int channels,
           const std::optional<SampleLimit>& limit = std::nullopt);

  const PixelBounds& sampled() const { return sampled_; }
  const PixelBounds& stored() const { return stored_; }

  /// Adds a sample to a pixel (unit box filter only).
  void add_to_pixel(int x, int y, std::span<const float> values);
  /// Adds a sample at a film position to all pixels within the filter's reach.
  void add_sample(const ReconstructionFilter& filter, const Point2f& position,
                  std::span<const float> values);
  /// Takes note of `count` more samples in every pixel.
  void count_samples(uint32_t count) { samples_ += count; }
  /// Samples that every pixel has, as far as they have been counted.
  uint64_t samples() const { return samples_; }
  /// Per stored pixel the sum of weights, then the weighted sum of each channel.
  std::span<const double> data() const { return data_; }

 private:
  friend class Film;
  double* sums(int x, int y) {
    return &data_[(size_t(y - stored_.y0) * stored_.width() + (x - stored_.x0)) * (channels_ + 1)];
  }
  PixelBounds sampled_, stored_;
  int channels_;
  std::optional<SampleLimit> limit_;
  uint64_t samples_ = 0;
  std::vector<double> data_;
};

/// Contribution of a light sub-path at a film position.
struct Splat {
  Point2f position;
  Spectrum value;
};

/// What a film looks like before it has samples.
struct FilmLayout {
  Point2i full;      ///< size of the whole image
  PixelBounds crop;  ///< the window to be developed within it
  FilterDescription filter;
  /// Samples are taken in the window alone, as if the image ended there: that is what the window of
  /// a scene file means. Otherwise the window is cut out of the whole image.
  bool ends_at_crop = false;
  /// Of the channels R, G and B; without, they stay as they are.
  std::optional<FilmResponse> response = std::nullopt;
  /// Of the samples' channels R, G and B; splats have no limit.
  std::optional<SampleLimit> sample_limit = std::nullopt;
};

/// A film is the set of its tiles. Their grid is anchored at the full image's origin, so that a
/// crop window has the very samples, and the very sums, of the full image.
class Film {
 public:
  static constexpr int kTileSize = 16;

  /// Samples are taken in the window and within the filter's reach around it, but never outside the
  /// image, or outside the window if the image ends there.
  Film(const FilmLayout& layout, std::vector<std::string> channels);

  /// Bytes that the tiles of such a film take, without making them.
  static double tile_bytes(const FilmLayout& layout, size_t channels);
  /// Bytes that splats and moments take besides.
  double layer_bytes() const;

  const ReconstructionFilter& filter() const { return filter_; }
  const PixelBounds& crop() const { return crop_; }
  Point2i full_size() const { return full_; }
  const std::vector<std::string>& channels() const { return channels_; }
  std::vector<FilmTile>& tiles() { return tiles_; }
  const std::vector<FilmTile>& tiles() const { return tiles_; }

  /// Makes room for splats that add to three channels from `first_channel` on. Returns the number
  /// of the layer.
  size_t add_splat_layer(size_t first_channel);
  /// Adds splats, scaled by `scale`, to a layer. They go through the same filter as samples do, so
  /// that a unit of light per pixel area adds one to each pixel. The sum does not depend on the
  /// number of threads.
  void add_splats(size_t layer, std::span<const Splat> splats, float scale, int threads);
  /// Makes three channels from `first_channel` on the mean of the squares of what each pass makes
  /// of a pixel's first three channels, splats included: samples alone do not know of those.
  void add_moments(size_t first_channel);
  /// To be called after each pass with splats: these are divided by the number of passes.
  void end_pass();
  /// What the splats of a layer add to a channel of a pixel of the window.
  double splat_mean(size_t layer, int x, int y, int channel) const;
  size_t splat_layer_count() const { return splats_.size(); }
  int passes() const { return passes_; }

  /// The weighted means of the window's pixels, with splats; a pixel that nothing reached is zero.
  /// Where tiles have samples of different numbers, each tile counts for a pixel between them as
  /// much as its share of the filter, however many samples it has.
  Image develop() const;
  /// The mean of films of the same layout. Each that has samples in a tile counts the same there,
  /// so that numbers of samples which depend on other films leave the mean unbiased.
  static Film mean(std::span<const Film> films);

 private:
  /// Applies the response to a developed image.
  void respond(Image& image) const;

  Point2i full_;
  PixelBounds crop_;
  PixelBounds image_;  ///< where there is light
  ReconstructionFilter filter_;
  std::optional<FilmResponse> response_;
  std::vector<std::string> channels_;
  std::vector<FilmTile> tiles_;

  struct SplatLayer {
    size_t first_channel;
    std::vector<double> sums;  ///< three per pixel of the window
  };
  std::vector<SplatLayer> splats_;
  int passes_ = 0;
  /// Where moments go. Sums over the passes of what each made of a pixel's colours, and of its
  /// squares: three per pixel of the window, or none.
  std::vector<size_t> moment_channels_;
  std::vector<double> colour_sums_, squares_;
  /// Per column and row of the window: integral of the filter over image_.
  std::vector<double> filter_x_, filter_y_;
};

}  // namespace duet
