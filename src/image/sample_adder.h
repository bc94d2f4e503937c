// Adds samples to a film.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "image/film.h"

namespace duet {

/// Adds samples to a tile of a film, for one thread. Their sums are in the tile when this ends.
/// Every value times its weight, exact in double precision, is rounded to two numbers: a multiple
/// of 2⁻³², and of the rest a multiple of 2⁻⁶⁴. Few enough of each are added in double precision
/// without rounding.
class SampleAdder {
 public:
  SampleAdder(const Film& film, FilmTile& tile);
  ~SampleAdder() { move_to_tile(); }
  SampleAdder(const SampleAdder&) = delete;
  SampleAdder& operator=(const SampleAdder&) = delete;

  /// Adds a sample that was taken in the pixel (x, y), at a film position, to all pixels within the
  /// filter's reach. The film must be able to add its values.
  void add(int x, int y, const Point2f& position, std::span<const float> values);

 private:
  void take(std::span<const float> values);
  /// Adds the sample to neighbouring pixels with these weights; `at` is where their sums begin.
  void add(size_t at, std::span<const float> weights, float factor);
  /// Adds it to one pixel alone.
  void add_to_pixel(size_t at);
  void move_to_tile();

  const ReconstructionFilter& filter_;
  std::optional<SampleLimit> limit_;
  FilmTile& tile_;
  std::vector<double> sample_;    ///< one, for the sum of weights, and the values of the sample
  std::vector<double> weighted_;  ///< the same for a row of pixels
  bool is_large_ = false;         ///< the sample goes to the tile itself
  uint32_t added_ = 0;            ///< samples since sums were moved to the tile
  std::vector<double> coarse_, fine_;
};

}  // namespace duet
