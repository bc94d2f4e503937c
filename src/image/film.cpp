#include "image/film.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace duet {

namespace {

/// Where there is light: all of the image, or the window.
PixelBounds lit_part(const FilmLayout& layout) {
  return layout.ends_at_crop ? layout.crop : PixelBounds{0, 0, layout.full.x, layout.full.y};
}

/// Calls `f(sampled, stored)` for the tiles of a film, row by row.
template <class F>
void for_tiles(const FilmLayout& layout, int border, F&& f) {
  constexpr int kSize = Film::kTileSize;
  const PixelBounds sampled = layout.crop.grow(border).intersect(lit_part(layout));
  for (int ty = sampled.y0 / kSize; ty * kSize < sampled.y1; ++ty)
    for (int tx = sampled.x0 / kSize; tx * kSize < sampled.x1; ++tx) {
      const PixelBounds square{tx * kSize, ty * kSize, (tx + 1) * kSize, (ty + 1) * kSize};
      const PixelBounds inside = square.intersect(sampled);
      const PixelBounds stored = inside.grow(border).intersect(layout.crop);
      if (!stored.empty()) f(inside, stored);
    }
}

}  // namespace

float SampleLimit::share(const float* rgb) const {
  double largest = 0;
  for (const auto& row : sensor)
    largest = std::max(largest,
                       row[0] * double(rgb[0]) + row[1] * double(rgb[1]) + row[2] * double(rgb[2]));
  return largest > most ? float(most / largest) : 1.0f;
}

Film::Film(const FilmLayout& layout, std::vector<std::string> channels)
    : layout_(layout),
      image_(lit_part(layout)),
      filter_(layout.filter),
      channels_(std::move(channels)) {
  for_tiles(layout, filter_.border(), [&](const PixelBounds& sampled, const PixelBounds& stored) {
    tiles_.emplace_back(sampled, stored, channels_.size());
  });
}

Film::Film(const FilmLayout& layout, const FilmContents& contents)
    : Film(layout, contents.channels) {
  for (const size_t first : contents.splats) add_splat_layer(first);
  for (const size_t first : contents.moments) add_moments(first);
  statistics_ = contents.statistics;
}

FilmContents Film::contents() const {
  FilmContents contents{channels_, {}, moment_channels_, statistics_};
  for (const SplatLayer& layer : splats_) contents.splats.push_back(layer.first_channel);
  return contents;
}

bool Film::has_colours() const {
  return channels_.size() >= 3 && channels_[0] == "R";
}

std::optional<SampleLimit> Film::sample_limit() const {
  return has_colours() ? layout_.sample_limit : std::nullopt;
}

double Film::tile_bytes(const FilmLayout& layout, size_t channels) {
  // What an allocation takes besides.
  constexpr double kHead = 16;
  double bytes = 0;
  for_tiles(layout, ReconstructionFilter(layout.filter).border(),
            [&](const PixelBounds&, const PixelBounds& stored) {
              bytes += sizeof(FilmTile) + kHead +
                       double(stored.width()) * stored.height() *
                           double((channels + 1) * sizeof(ExactSum));
            });
  return bytes;
}

double Film::layer_bytes(const FilmLayout& layout) const {
  const double pixels = double(layout.crop.width()) * layout.crop.height();
  const double splats = pixels * double(3 * splats_.size() * sizeof(ExactSum));
  if (moment_channels_.empty()) return splats;
  // The film of a pass besides.
  return 2 * splats + pixels * double(3 * sizeof(ExactSum)) + tile_bytes(layout, channels_.size());
}

std::vector<double> Film::tile_scales(std::span<const Film> films) const {
  std::vector<double> filled(tiles_.size());  // films that have samples in the tile
  double most = 0;
  for (size_t k = 0; k < tiles_.size(); ++k) {
    double total = 0;
    for (const Film& f : films) {
      total += double(f.tiles_[k].samples());
      filled[k] += f.tiles_[k].samples() > 0;
    }
    most = std::max(most, total);
  }
  std::vector<double> scales;
  scales.reserve(tiles_.size() * films.size());
  for (size_t k = 0; k < tiles_.size(); ++k)
    for (const Film& f : films) {
      const auto samples = double(f.tiles_[k].samples());
      // As if the tile had the most samples, in films that count the same. Samples that nobody has
      // counted are all there are.
      scales.push_back(filled[k] == 0 ? 1 : samples > 0 ? most / (filled[k] * samples) : 0);
    }
  return scales;
}

void Film::add_means(std::span<const Film> films, std::span<const double> scales, Rows rows,
                     std::vector<double>& sums) const {
  const size_t stride = channels_.size() + 1;
  const int y0 = crop().y0 + rows.first, y1 = crop().y0 + rows.end;
  // Tiles stand row by row.
  const auto begin = std::partition_point(tiles_.begin(), tiles_.end(),
                                          [&](const FilmTile& t) { return t.stored().y1 <= y0; });
  for (auto k = size_t(begin - tiles_.begin()); k < tiles_.size(); ++k) {
    const PixelBounds& b = tiles_[k].stored();
    if (b.y0 >= y1) break;
    for (size_t f = 0; f < films.size(); ++f) {
      const double scale = scales[k * films.size() + f];
      if (scale == 0) continue;
      const FilmTile& tile = films[f].tiles_[k];
      for (int y = std::max(b.y0, y0); y < std::min(b.y1, y1); ++y) {
        const ExactSum* from = &tile.sums()[tile.index(b.x0, y)];
        const size_t pixel = window_pixel(b.x0, y) - pixels_of(rows).first;
        double* to = &sums[pixel * stride];
        for (size_t i = 0; i < size_t(b.width()) * stride; ++i) *to++ += scale * from++->value();
      }
    }
  }
}

Image Film::develop(std::span<const Film> films, int threads) {
  const Film& first = films[0];
  Image image(first.crop().width(), first.crop().height(), first.channels_);
  const std::vector<double> scales = first.tile_scales(films);
  parallel_for(size_t(first.splat_bands()), threads, [&](size_t band) {
    const int from = int(band) * kTileSize;
    first.develop(films, scales, {from, std::min(from + kTileSize, image.height)}, image);
  });
  return image;
}

void Film::develop(std::span<const Film> films, std::span<const double> scales, Rows rows,
                   Image& image) const {
  const size_t n = channels_.size();
  const auto [begin, end] = pixels_of(rows);
  std::vector<double> sums((end - begin) * (n + 1));
  add_means(films, scales, rows, sums);
  float* out = image.data.data() + begin * n;
  for (size_t i = 0; i < sums.size(); i += n + 1) {
    const double w = sums[i];
    for (size_t c = 1; c <= n; ++c) *out++ = w != 0 ? float(sums[i + c] / w) : 0.0f;
  }
  add_splat_means(films, rows, image);
  add_squares(films, rows, image);
  compute_statistics(films, rows, image);
  respond(rows, image);
}

namespace {

/// A statistic of `spp` samples by the means of their squares and of themselves, which are
/// multiplied by `gain` afterwards.
float spread_of(FilmStatistic::Kind kind, float square, float mean, double spp, float gain) {
  const float spread = std::max(0.0f, square - mean * mean) * gain * gain;
  if (kind == FilmStatistic::Kind::variance) return spread / float(std::max(1.0, spp));
  const float variance = spread * float(spp / std::max(1.0, spp - 1));
  if (kind == FilmStatistic::Kind::sample_variance) return variance;
  return mean != 0 ? variance / (mean * gain) : 0.0f;
}

}  // namespace

void Film::compute_statistics(std::span<const Film> films, Rows rows, Image& image) const {
  if (statistics_.empty() || tiles_.empty()) return;
  double spp = 0;
  for (const Film& f : films) spp += double(f.tiles_[0].samples());
  const size_t n = channels_.size();
  const auto [begin, end] = pixels_of(rows);
  // The response to the colours of grey: others have no squares that would tell what becomes of
  // them.
  std::array<float, 3> gain{1, 1, 1};
  if (layout_.response)
    for (size_t c = 0; c < 3; ++c) {
      const auto& row = (*layout_.response)[c];
      gain[c] = float(row[0] + row[1] + row[2]);
    }
  for (const FilmStatistic& s : statistics_)
    for (size_t i = begin * n; i < end * n; i += n) {
      const float* colour = &image.data[i];
      float* out = &image.data[i + s.channel];
      if (s.kind == FilmStatistic::Kind::samples) {
        out[0] = float(spp);
        continue;
      }
      for (size_t c = 0; c < 3; ++c) out[c] = spread_of(s.kind, out[c], colour[c], spp, gain[c]);
    }
}

void Film::respond(Rows rows, Image& image) const {
  const size_t n = channels_.size();
  if (!layout_.response || !has_colours()) return;
  const auto [begin, end] = pixels_of(rows);
  for (size_t i = begin * n; i < end * n; i += n) {
    const std::array<float, 3> from{image.data[i], image.data[i + 1], image.data[i + 2]};
    for (size_t c = 0; c < 3; ++c) {
      const auto& row = (*layout_.response)[c];
      image.data[i + c] =
          float(row[0] * double(from[0]) + row[1] * double(from[1]) + row[2] * double(from[2]));
    }
  }
}

void Film::add_moments(size_t first_channel) {
  moment_channels_.push_back(first_channel);
  squares_.resize(3 * size_t(crop().width()) * size_t(crop().height()));
}

void Film::add_squares(std::span<const Film> films, Rows rows, Image& image) const {
  const double filled = count_filled(films);
  const auto [begin, end] = pixels_of(rows);
  for (const size_t first : moment_channels_)
    for (size_t i = 3 * begin; i < 3 * end; ++i) {
      double sum = 0;
      for (const Film& f : films)
        if (f.passes_ > 0) sum += f.squares_[i].value() / f.passes_;
      image.data[i / 3 * channels_.size() + first + i % 3] =
          filled > 0 ? float(sum / filled) : 0.0f;
    }
}

double Film::count_filled(std::span<const Film> films) {
  double filled = 0;
  for (const Film& f : films) filled += f.passes_ > 0;
  return filled;
}

Film& Film::begin_pass() {
  if (moment_channels_.empty()) return *this;
  if (!pass_) {
    pass_ = std::make_unique<Film>(layout_, channels_);
    for (const SplatLayer& layer : splats_) pass_->add_splat_layer(layer.first_channel);
  }
  return *pass_;
}

void Film::end_pass() {
  if (pass_) {
    pass_->passes_ = 1;
    const Image colours = pass_->develop();
    for (size_t i = 0; i < squares_.size(); ++i) {
      const auto colour = double(colours.data[i / 3 * channels_.size() + i % 3]);
      squares_[i].add(std::min(colour * colour, ExactSum::kLargest));
    }
    add_film(*pass_);
    pass_->clear();
  }
  ++passes_;
}

void Film::add_film(const Film& o) {
  for (size_t k = 0; k < tiles_.size(); ++k) tiles_[k].add(o.tiles_[k]);
  for (size_t k = 0; k < splats_.size(); ++k)
    for (size_t i = 0; i < splats_[k].sums.size(); ++i)
      splats_[k].sums[i].add(o.splats_[k].sums[i]);
}

void Film::clear() {
  for (FilmTile& tile : tiles_) tile.clear();
  for (SplatLayer& layer : splats_) std::fill(layer.sums.begin(), layer.sums.end(), ExactSum());
}

}  // namespace duet
