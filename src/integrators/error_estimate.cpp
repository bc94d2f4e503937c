#include "integrators/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace duet {

namespace {

/// The first channels of a film are its colours, unless only layers were asked for.
int color_channels(const Film& film) {
  return film.channels().size() >= 3 && film.channels()[0] == "R" ? 3 : 0;
}

}  // namespace

std::optional<double> batch_relative_rmse(const std::vector<Film>& films, int threads) {
  const int channels = color_channels(films[0]);
  if (channels == 0) return std::nullopt;
  std::vector<Image> images;
  for (const Film& f : films) images.push_back(f.develop(threads));
  const size_t pixels = size_t(images[0].width) * images[0].height;
  const double n = double(images.size());
  double variance = 0, total = 0;
  for (size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < channels; ++c) {
      const size_t at = i * images[0].channels.size() + c;
      double sum = 0, squares = 0;
      for (const Image& image : images) sum += image.data[at];
      for (const Image& image : images) squares += std::pow(image.data[at] - sum / n, 2);
      variance += squares / (n - 1) / n;
      total += sum / n;
    }
  if (!(total > 0)) return std::nullopt;
  const double values = double(pixels) * channels;
  return std::sqrt(variance / values) / (total / values);
}

PartialMeans::PartialMeans(const Film& film) : channels_(color_channels(film)) {
  for (const FilmTile& t : film.tiles()) {
    const PixelBounds own = t.stored().intersect(t.sampled());
    const size_t pixels = own.empty() ? 0 : size_t(own.width()) * size_t(own.height());
    before_.emplace_back(pixels);
    last_.emplace_back(pixels);
  }
  if (film.splat_layer_count() > 0)
    splats_before_.resize(size_t(film.crop().width()) * size_t(film.crop().height()) * 3);
}

double PartialMeans::splats_of_part(const Film& film, int x, int y, int c, double& mean) {
  const PixelBounds& crop = film.crop();
  const size_t pixel = size_t(y - crop.y0) * size_t(crop.width()) + size_t(x - crop.x0);
  double& before = splats_before_[pixel * 3 + size_t(c)];
  mean = film.splat_mean(0, x, y, c);
  const double passes = film.passes(), new_passes = passes - passes_before_;
  const double sum = mean * passes - std::exchange(before, mean) * passes_before_;
  return new_passes > 0 ? sum / new_passes : 0.0;
}

PartialMeans::TileSums PartialMeans::add_tile(const Film& film, size_t k) {
  TileSums sums;
  Sums now{};
  const FilmTile& tile = film.tiles()[k];
  const PixelBounds own = tile.stored().intersect(tile.sampled());
  size_t i = 0;
  for (int y = own.y0; y < own.y1; ++y)
    for (int x = own.x0; x < own.x1; ++x, ++i) {
      const size_t at = tile.index(x, y);
      for (size_t c = 0; c <= size_t(channels_); ++c) now[c] = tile.sums()[at + c].value();
      const Sums then = std::exchange(before_[k][i], now);
      sums.weight += now[0];
      sums.pixels += 1;
      Pixel& last = last_[k][i];
      const double w = now[0] - then[0];
      for (int c = 0; c < channels_; ++c) {
        sums.total += now[c + 1];
        double mean = w > 0 ? (now[c + 1] - then[c + 1]) / w : 0;
        if (!splats_before_.empty()) {
          double splats;
          mean += splats_of_part(film, x, y, c, splats);
          sums.total += splats * now[0];
        }
        if (parts_ > 0 && w > 0 && last.weight > 0) {
          sums.variance.squares +=
              std::pow(mean - last.mean[c], 2) / (1 / w + 1 / double(last.weight));
          sums.variance.count += 1;
        }
        last.mean[c] = float(mean);
      }
      last.weight = float(w);
    }
  return sums;
}

void PartialMeans::add_part(const Film& film, int threads) {
  std::vector<TileSums> tiles(film.tiles().size());
  parallel_for(tiles.size(), threads, [&](size_t k) { tiles[k] = add_tile(film, k); });
  total_ = weight_ = pixels_ = 0;
  for (const TileSums& t : tiles) {
    variance_.squares += t.variance.squares, variance_.count += t.variance.count;
    total_ += t.total, weight_ += t.weight, pixels_ += t.pixels;
  }
  passes_before_ = film.passes();
  ++parts_;
}

std::optional<double> PartialMeans::relative_rmse() const {
  if (!(variance_.count > 0) || !(total_ > 0) || !(weight_ > 0)) return std::nullopt;
  const double per_sample = variance_.squares / variance_.count;
  const double mean = total_ / (channels_ * weight_);
  return std::sqrt(per_sample / (weight_ / pixels_)) / mean;
}

}  // namespace duet
