// The sums of a film as planes, for files.
#include <fmt/format.h>

#include <algorithm>

#include "image/film.h"

namespace duet {

namespace {

/// Tiles side by side in a row of tiles.
size_t tile_columns(const std::vector<FilmTile>& tiles) {
  size_t n = 0;
  while (n < tiles.size() && tiles[n].stored().y0 == tiles[0].stored().y0) ++n;
  return n;
}

std::vector<std::string> color_sums() {
  return {"R", "G", "B"};
}

}  // namespace

std::vector<FilmPlane> Film::planes() const {
  std::vector<FilmPlane> planes;
  FilmPlane samples{"samples", 0, 0, {"weight"}};
  samples.sums.insert(samples.sums.end(), channels_.begin(), channels_.end());
  const size_t columns = tile_columns(tiles_);
  for (size_t i = 0; i < columns; ++i) samples.width += tiles_[i].stored().width();
  for (size_t i = 0; i < tiles_.size(); i += columns) samples.height += tiles_[i].stored().height();
  planes.push_back(std::move(samples));
  for (size_t i = 0; i < splats_.size(); ++i)
    planes.push_back({fmt::format("splats{}", i), crop().width(), crop().height(), color_sums()});
  if (!squares_.empty())
    planes.push_back({"squares", crop().width(), crop().height(), color_sums()});
  return planes;
}

template <class Self, class F>
void Film::for_row(Self& film, size_t plane, int y, const F& f) {
  if (plane > 0) {
    auto& sums = plane <= film.splats_.size() ? film.splats_[plane - 1].sums : film.squares_;
    const size_t n = 3 * size_t(film.crop().width());
    return f(std::span(sums).subspan(size_t(y) * n, n));
  }
  const size_t columns = tile_columns(film.tiles_);
  size_t first = 0;  // of the row of tiles
  for (; y >= film.tiles_[first].stored().height(); first += columns)
    y -= film.tiles_[first].stored().height();
  for (size_t i = first; i < first + columns; ++i) {
    auto& tile = film.tiles_[i];
    const size_t n = size_t(tile.stored().width()) * (film.channels_.size() + 1);
    f(tile.sums().subspan(size_t(y) * n, n));
  }
}

void Film::read_row(size_t plane, int y, std::span<ExactSum> row) const {
  size_t at = 0;
  for_row(*this, plane, y, [&](std::span<const ExactSum> sums) {
    std::copy(sums.begin(), sums.end(), row.begin() + ptrdiff_t(at));
    at += sums.size();
  });
}

void Film::add_row(size_t plane, int y, std::span<const ExactSum> row) {
  size_t at = 0;
  for_row(*this, plane, y, [&](std::span<ExactSum> sums) {
    for (ExactSum& sum : sums) sum.add(row[at++]);
  });
}

void Film::count(int passes, std::span<const uint64_t> tile_samples) {
  passes_ += passes;
  for (size_t i = 0; i < tiles_.size(); ++i) tiles_[i].count_samples(tile_samples[i]);
}

}  // namespace duet
