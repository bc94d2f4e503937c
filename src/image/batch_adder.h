// Adds batches of samples to a film.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "image/batch_sums.h"
#include "image/sample_adder.h"

namespace duet {

/// Where each sample of a batch is on the film, and what it brings, row by row of its square.
struct BatchSamples {
  const BatchArray<float>&x, &y;
  const BatchArray<float>&r, &g, &b, &alpha;
};

/// Adds batches of samples, one in each pixel of a square, to a tile of a film, for one thread.
/// Their sums are in the tile when this ends; they are those of SampleAdder, bit for bit.
class BatchAdder {
 public:
  /// Whether this can add to the film: it holds colours and alpha, samples have no limit, and the
  /// filter reaches other pixels, but not beyond the third.
  static bool suits(const Film& film);

  /// `square` are the pixels of a batch, at most as many as a tile has; those that the tile does
  /// not sample are left out.
  BatchAdder(const Film& film, FilmTile& tile, const PixelBounds& square);
  ~BatchAdder() { move_to_tile(); }
  BatchAdder(const BatchAdder&) = delete;
  BatchAdder& operator=(const BatchAdder&) = delete;

  /// The film must be able to add the values of all pixels that are not left out.
  void add(const BatchSamples& samples);

 private:
  void place_row(const BatchSamples& samples, int row, bool opaque);
  /// Takes those samples out of the placed row that are too large for it and adds them one by one.
  void add_large(const BatchSamples& samples, int row);
  bool is_opaque(const BatchSamples& samples) const;
  void clear();
  void move_to_tile();

  const Film& film_;
  FilmTile& tile_;
  PixelBounds square_;
  PixelBounds sampled_;  ///< columns and rows of the square whose samples count
  std::array<int, BatchFootprints::kSide> counts_{};  ///< 1 for those columns, otherwise 0
  std::unique_ptr<BatchFootprints> batch_;
  std::unique_ptr<BatchSums<ExactBatchSums>> sums_;
  /// Batches since sums were moved to the tile, and of which kinds.
  int added_ = 0;
  bool has_opaque_ = false, has_holes_ = false;
  std::optional<SampleAdder> large_;  ///< for what batches cannot hold
};

}  // namespace duet
