// Sums of batches of samples in lanes: the loops, whatever the sums are made of.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "base/instruction_sets.h"
#include "math/batch.h"

namespace duet {

/// One sample of each pixel of a square, weighted for the pixels in its reach. Samples are in rows
/// of `pitch`, which is as many pixels as a row of them can reach: so all rows are one loop. What
/// lies between rows, and before the first, has weights of zero.
struct BatchFootprints {
  static constexpr int kSide = 16;      ///< samples in a row, and rows
  static constexpr int kMostReach = 3;  ///< pixels beyond its own that a sample can reach
  static constexpr int kMostWeights = 2 * kMostReach + 1;
  static constexpr int kMostPitch = kSide + 2 * kMostReach;
  static constexpr int kLead = 8;  ///< numbers before the first sample
  static constexpr int kLength = kLead + kSide * kMostPitch + 8;
  static constexpr int kColours = 3;
  static_assert(kSide * kSide == kBatch && kLead >= 2 * kMostReach);

  int reach_x = 0, reach_y = 0;
  /// By the offset, along each axis, of the pixel: 0 is the one `reach` before the sample's own.
  alignas(64) float weights_x[kMostWeights][kLength] = {};
  alignas(64) float weights_y[kMostWeights][kLength] = {};
  alignas(64) double colours[kColours][kLength] = {};
  alignas(64) double alpha[kLength] = {};

  int pitch() const { return kSide + 2 * reach_x; }
  /// Where a sample is.
  int index(int column, int row) const { return kLead + row * pitch() + column; }
};

/// How many pixels a batch can reach at most.
inline constexpr int kMostBatchPixels = BatchFootprints::kMostPitch * BatchFootprints::kMostPitch;

/// Exact sums of pixels, for few enough numbers whose absolute value is below 64: each is rounded
/// to a multiple of 2⁻³², and what is left to one of 2⁻⁶⁴. Adding to a number of about 2²⁰ is what
/// rounds to the former: the sums begin at kCoarse. The latter are added as integers, which are the
/// lower bits of the number that rounding by kFine leaves.
/// Source of the rounding: Demmel & Nguyen, "Fast Reproducible Floating-Point Summation", 2013.
struct ExactBatchSums {
  static constexpr double kCoarse = 0x1.8p20, kFine = 0x1.8p-12;
  /// Of kFine, and of any sum of such, bits below this are zero.
  static constexpr int kFineBits = 51;

  alignas(64) double coarse[kMostBatchPixels];
  alignas(64) uint64_t fine[kMostBatchPixels];

  struct Lane {
    double coarse;
    uint64_t fine;
    [[gnu::always_inline]] void add(double x) {
      const double sum = coarse + x;
      const double rest = x - (sum - coarse);
      coarse = sum;
      fine += std::bit_cast<uint64_t>(rest + kFine);
    }
  };
  [[gnu::always_inline]] Lane lane(int i) const { return {coarse[i], fine[i]}; }
  [[gnu::always_inline]] void set(int i, const Lane& lane) {
    coarse[i] = lane.coarse, fine[i] = lane.fine;
  }
  /// The sum in units of 2⁻³² and, what is left, of 2⁻⁶⁴.
  int64_t coarse_units(int i) const { return int64_t((coarse[i] - kCoarse) * 0x1p32); }
  int64_t fine_units(int i) const {
    constexpr int kAbove = 64 - kFineBits;
    return int64_t(fine[i] << kAbove) >> kAbove;
  }
};

/// Weights of samples for the pixels of some row, at one offset along y: those of each offset along
/// x, by the pixel.
struct alignas(64) BatchRowWeights {
  double at[BatchFootprints::kMostWeights][BatchFootprints::kLength];
};

/// The weights of all samples for pixels `row` below the first that they can reach.
template <int kWeights>
[[gnu::always_inline]] inline void multiply_batch_weights(const BatchFootprints& batch, int row,
                                                          BatchRowWeights& weights) {
  const int count = BatchFootprints::kSide * (BatchFootprints::kSide + kWeights - 1);
  for (int k = 0; k < kWeights; ++k) {
    const float* const along_x = batch.weights_x[k] + BatchFootprints::kLead - k;
    const float* const along_y = batch.weights_y[row] + BatchFootprints::kLead - k;
    double* const product = weights.at[k];
    DUET_LANES
    for (int i = 0; i < count; ++i) product[i] = double(along_x[i] * along_y[i]);
  }
}

/// Adds the samples' values times weights to pixels from `first` on; one for each value if there
/// are none. All weights of a pixel in one step: sums stay in registers.
template <int kWeights, class Sums>
[[gnu::always_inline]] inline void add_batch_row(const BatchRowWeights& weights,
                                                 const double* values, int first, Sums& sums) {
  const int count = BatchFootprints::kSide * (BatchFootprints::kSide + kWeights - 1);
  const auto add = [&]<bool kHasValues, int... k>(std::bool_constant<kHasValues>,
                                                  std::integer_sequence<int, k...>)
      __attribute__((always_inline)) {
    DUET_LANES
    for (int i = 0; i < count; ++i) {
      auto lane = sums.lane(first + i);
      if constexpr (kHasValues)
        (lane.add(weights.at[k][i] * values[i - k]), ...);
      else
        (lane.add(weights.at[k][i]), ...);
      sums.set(first + i, lane);
    }
  };
  constexpr std::make_integer_sequence<int, kWeights> kOffsets;
  if (values)
    add(std::true_type(), kOffsets);
  else
    add(std::false_type(), kOffsets);
}

/// The sums of a batch. In a batch without holes alpha has the sums that the weights have.
template <class Sums>
struct BatchSums {
  Sums opaque_weight, weight, alpha, colours[BatchFootprints::kColours];
};

/// Adds a batch whose samples reach (kWeights - 1) / 2 pixels along x.
template <int kWeights, class Sums>
[[gnu::always_inline]] inline void add_batch(const BatchFootprints& batch, bool is_opaque,
                                             BatchSums<Sums>& sums) {
  BatchRowWeights weights;
  for (int row = 0; row <= 2 * batch.reach_y; ++row) {
    const int first = row * batch.pitch();
    multiply_batch_weights<kWeights>(batch, row, weights);
    add_batch_row<kWeights>(weights, nullptr, first, is_opaque ? sums.opaque_weight : sums.weight);
    if (!is_opaque)
      add_batch_row<kWeights>(weights, batch.alpha + BatchFootprints::kLead, first, sums.alpha);
    for (int c = 0; c < BatchFootprints::kColours; ++c)
      add_batch_row<kWeights>(weights, batch.colours[c] + BatchFootprints::kLead, first,
                              sums.colours[c]);
  }
}

}  // namespace duet
