#include "integrators/tile_work.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "base/parallel.h"

namespace duet {

namespace {

/// So many for each thread keep the last ones from waiting for each other.
constexpr size_t kPiecesPerThread = 4;
/// A part of a tile's samples has as many: sums of its own are worth it then.
constexpr uint32_t kFewestSamples = 4;

struct Piece {
  size_t tile;
  PixelBounds pixels;
  TileSamples samples;
  bool counts;  ///< whether its samples are counted: those of other rows are the same
};

/// Part `i` of `n` of so many.
uint32_t part(uint32_t count, uint32_t i, uint32_t n) {
  return uint32_t(uint64_t(count) * i / n);
}

class Pieces {
 public:
  Pieces(const Film& film, const SampleRange& range, int threads, TileSplit split) {
    const size_t tiles = film.tiles().size(), wanted = kPiecesPerThread * size_t(threads);
    const auto parts = uint32_t(tiles > 0 && threads > 1 ? (wanted + tiles - 1) / tiles : 1);
    for (size_t k = 0; k < tiles; ++k) {
      const TileSamples all = samples_of_tile(range, k);
      if (all.count > 0) add_tile(k, film.tiles()[k].sampled(), all, parts, split);
    }
  }
  const std::vector<Piece>& all() const { return pieces_; }

 private:
  void add_tile(size_t tile, const PixelBounds& pixels, const TileSamples& all, uint32_t parts,
                TileSplit split) {
    const uint32_t by_samples = std::clamp(all.count / kFewestSamples, 1u, parts);
    uint32_t by_rows = 1;
    if (split == TileSplit::by_samples_and_rows)
      by_rows = std::clamp(parts / by_samples, 1u, uint32_t(std::max(1, pixels.height())));
    for (uint32_t s = 0; s < by_samples; ++s) {
      const uint32_t first = part(all.count, s, by_samples);
      const TileSamples samples{all.first + first, part(all.count, s + 1, by_samples) - first};
      for (uint32_t r = 0; r < by_rows; ++r) {
        PixelBounds rows = pixels;
        rows.y0 = pixels.y0 + int(part(uint32_t(pixels.height()), r, by_rows));
        rows.y1 = pixels.y0 + int(part(uint32_t(pixels.height()), r + 1, by_rows));
        pieces_.push_back({tile, rows, samples, r == 0});
      }
    }
  }

  std::vector<Piece> pieces_;
};

}  // namespace

void for_each_tile(
    Film& film, const SampleRange& range, const PassControl& control, TileSplit split,
    RenderCounters& counters,
    const std::function<void(FilmTile&, const TileSamples&, RenderCounters&)>& work) {
  const Pieces pieces(film, range, control.threads, split);
  const std::vector<Piece>& all = pieces.all();
  std::vector<RenderCounters> of_piece(all.size());
  std::vector<std::mutex> locks(film.tiles().size());
  std::atomic<size_t> done{0};
  // All phases of a sample are one.
  const bool counts = !range.phase || range.phase->index == 0;
  parallel_for(all.size(), control.threads, [&](size_t i) {
    if (control.cancelled()) return;
    const Piece& piece = all[i];
    FilmTile& tile = film.tiles()[piece.tile];
    const uint64_t count = piece.counts && counts ? piece.samples.count : 0;
    if (piece.pixels == tile.sampled() &&
        piece.samples.count == samples_of_tile(range, piece.tile).count) {
      work(tile, piece.samples, of_piece[i]);
      tile.count_samples(count);
    } else {
      const PixelBounds reached = piece.pixels.grow(film.filter().border());
      FilmTile sums(piece.pixels, tile.stored().intersect(reached), film.channels().size());
      work(sums, piece.samples, of_piece[i]);
      sums.count_samples(count);
      const std::lock_guard lock(locks[piece.tile]);
      tile.add(sums);
    }
    control.report(double(++done) / double(all.size()));
  });
  for (const RenderCounters& c : of_piece) counters.add(c);
}

}  // namespace duet
