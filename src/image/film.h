// The film: gathers weighted samples and splats into pixels. All of its sums are exact, so it does
// not matter in which order, by which threads and in which passes they were added up.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "image/film_tile.h"
#include "image/image.h"
#include "math/spectrum.h"

namespace duet {

/// Whether a film can add such a splat.
inline bool film_can_add(const Spectrum& value) {
  const float values[]{value.r, value.g, value.b};
  return film_can_add(std::span<const float>(values));
}

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

/// Contribution of a light sub-path at a film position.
struct Splat {
  Point2f position;
  Spectrum value;
};

/// A rectangle of a film's sums, as files hold them.
struct FilmPlane {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::string> sums;  ///< what a pixel has
};

/// A channel of a film that is not a mean of samples.
struct FilmStatistic {
  enum class Kind {
    samples,   ///< how many each pixel has
    variance,  ///< of the colours, as if samples were independent: three channels, in which the
               ///< samples have the squares of their colours
    sample_variance,    ///< the same of the samples themselves, without bias
    relative_variance,  ///< that over the mean
  };
  Kind kind = Kind::samples;
  size_t channel = 0;  ///< the first
  bool operator==(const FilmStatistic&) const = default;
};

/// What a film gathers, by the first channel of each of its layers.
struct FilmContents {
  std::vector<std::string> channels;
  std::vector<size_t> splats, moments;
  std::vector<FilmStatistic> statistics;
  bool operator==(const FilmContents&) const = default;
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
  /// A film without samples that gathers what another does.
  Film(const FilmLayout& layout, const FilmContents& contents);
  FilmContents contents() const;
  const FilmLayout& layout() const { return layout_; }

  /// Bytes that the tiles of such a film take, without making them.
  static double tile_bytes(const FilmLayout& layout, size_t channels);
  /// Bytes that splats and moments take besides, if a film with such layers has this layout.
  double layer_bytes(const FilmLayout& layout) const;

  const ReconstructionFilter& filter() const { return filter_; }
  const PixelBounds& crop() const { return layout_.crop; }
  Point2i full_size() const { return layout_.full; }
  /// The layout's, if there are colours.
  std::optional<SampleLimit> sample_limit() const;
  const std::vector<std::string>& channels() const { return channels_; }
  std::vector<FilmTile>& tiles() { return tiles_; }
  const std::vector<FilmTile>& tiles() const { return tiles_; }

  /// Makes room for splats that add to three channels from `first_channel` on. Returns the number
  /// of the layer.
  size_t add_splat_layer(size_t first_channel);
  /// Adds splats, scaled by `scale`, to a layer, from any thread. They go through the same filter
  /// as samples do, so that a unit of light per pixel area adds one to each pixel.
  void add_splats(size_t layer, std::span<const Splat> splats, float scale);
  /// Makes three channels from `first_channel` on the mean of the squares of what each pass makes
  /// of a pixel's first three channels, splats included: samples alone do not know of those.
  void add_moments(size_t first_channel);
  /// Tiles must not have different numbers of samples then.
  void add_statistic(const FilmStatistic& statistic) { statistics_.push_back(statistic); }
  /// Where the samples and splats of the next pass go: this film, or one beside it if the film is
  /// to know the squares of passes.
  Film& begin_pass();
  /// To be called after each pass with splats: these are divided by the number of passes.
  void end_pass();
  /// What the splats of a layer add to a channel of a pixel of the window.
  double splat_mean(size_t layer, int x, int y, int channel) const;
  size_t splat_layer_count() const { return splats_.size(); }
  int passes() const { return passes_; }

  /// All sums: "samples" are the tiles side by side, each with the border that its samples reach;
  /// "splats0", "splats1" … the layers of splats and "squares" those of passes, by the window's
  /// pixels.
  std::vector<FilmPlane> planes() const;
  /// Copies a row of a plane, pixel by pixel, and adds one to this film.
  void read_row(size_t plane, int y, std::span<ExactSum> row) const;
  void add_row(size_t plane, int y, std::span<const ExactSum> row);
  /// Takes note of passes and of samples in each tile whose sums are added as rows.
  void count(int passes, std::span<const uint64_t> tile_samples);

  /// The weighted means of the window's pixels, with splats; a pixel that nothing reached is zero.
  /// Where tiles have samples of different numbers, each tile counts for a pixel between them as
  /// much as its share of the filter, however many samples it has.
  Image develop(int threads = 1) const { return develop(std::span(this, 1), threads); }
  /// The mean of films of the same layout. Each that has samples in a tile counts the same there,
  /// so that numbers of samples which depend on other films leave the mean unbiased.
  static Image develop(std::span<const Film> films, int threads = 1);

 private:
  struct SplatLayer {
    size_t first_channel;
    std::vector<ExactSum> sums;  ///< three per pixel of the window
  };

  /// Calls `f(sums)` for the pieces of a plane's row, one after the other.
  template <class Self, class F>
  static void for_row(Self& film, size_t plane, int y, const F& f);
  bool has_colours() const;
  /// How many of them have passes.
  static double count_filled(std::span<const Film> films);
  /// Of each tile, film by film: what its sums count for.
  std::vector<double> tile_scales(std::span<const Film> films) const;
  /// Some rows of the window, from its top.
  struct Rows {
    int first, end;
  };
  /// Each does its part of these rows of an image.
  void develop(std::span<const Film> films, std::span<const double> scales, Rows rows,
               Image& image) const;
  void add_means(std::span<const Film> films, std::span<const double> scales, Rows rows,
                 std::vector<double>& sums) const;
  void add_splat_means(std::span<const Film> films, Rows rows, Image& image) const;
  void add_squares(std::span<const Film> films, Rows rows, Image& image) const;
  void compute_statistics(std::span<const Film> films, Rows rows, Image& image) const;
  /// Applies the response to what has been developed.
  void respond(Rows rows, Image& image) const;
  /// Where the rows are among the pixels of the window.
  std::pair<size_t, size_t> pixels_of(Rows rows) const {
    const auto width = size_t(crop().width());
    return {size_t(rows.first) * width, size_t(rows.end) * width};
  }
  /// The number of a pixel of the window, row by row.
  size_t window_pixel(int x, int y) const {
    return size_t(y - crop().y0) * size_t(crop().width()) + size_t(x - crop().x0);
  }
  /// Bands of kTileSize rows of the window.
  int splat_bands() const { return (crop().height() + kTileSize - 1) / kTileSize; }
  /// What the sums of splats at a pixel of the window are to be divided by.
  double splat_filter(int x, int y) const;
  void add_film(const Film& o);
  void clear();

  FilmLayout layout_;
  PixelBounds image_;  ///< where there is light
  ReconstructionFilter filter_;
  std::vector<std::string> channels_;
  std::vector<FilmTile> tiles_;
  std::vector<SplatLayer> splats_;
  /// One for every band: who adds splats to it.
  std::unique_ptr<std::mutex[]> splat_locks_;
  int passes_ = 0;
  /// Where moments go, and sums of the squares of what each pass made of a pixel's colours: three
  /// per pixel of the window, or none.
  std::vector<size_t> moment_channels_;
  std::vector<ExactSum> squares_;
  std::vector<FilmStatistic> statistics_;
  std::unique_ptr<Film> pass_;  ///< the film of a pass, if there are moments
  /// Per column and row of the window: integral of the filter over image_.
  std::vector<double> filter_x_, filter_y_;
};

}  // namespace duet
