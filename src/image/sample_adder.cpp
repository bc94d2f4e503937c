#include "image/sample_adder.h"

#include <algorithm>
#include <array>

#include "base/instruction_sets.h"

namespace duet {

namespace {

/// Values of samples below this are added in double precision: with weights of at most two, sums of
/// kSamplesAtATime of them are below 2²¹, so that a multiple of 2⁻³² has no more than 53 bits.
constexpr double kSmall = 32;
constexpr uint32_t kSamplesAtATime = 1u << 14;
/// Adding and subtracting these rounds a small number to a multiple of 2⁻³² and of 2⁻⁶⁴.
constexpr double kCoarse = 0x1.8p20, kFine = 0x1.8p-12;

/// Adds a number below kSmall in two parts.
inline void add_parts(double weighted, double& coarse, double& fine) {
  const double whole = (weighted + kCoarse) - kCoarse;
  coarse += whole;
  fine += ((weighted - whole) + kFine) - kFine;
}

/// Copies values; whether all of them are below kSmall.
template <size_t N>
inline bool copy_small(std::span<const float, N> values, double* to) {
  bool small = true;
  for (size_t c = 0; c < values.size(); ++c) {
    to[c] = double(values[c]);
    small &= std::abs(values[c]) < float(kSmall);
  }
  return small;
}

/// Adds a sample to the pixels of a row, for a film of any channels. The lists do not overlap.
DUET_WIDE void add_row(std::span<const double> sample, std::span<const float> weights, float factor,
                       double* __restrict weighted, double* __restrict coarse,
                       double* __restrict fine) {
  const size_t n = sample.size(), count = n * weights.size();
  for (size_t p = 0; p < weights.size(); ++p)
    for (size_t c = 0; c < n; ++c) weighted[p * n + c] = double(weights[p] * factor) * sample[c];
  for (size_t i = 0; i < count; ++i) add_parts(weighted[i], coarse[i], fine[i]);
}

/// The same where a sample is colours and alpha, and a weight before them: a known number of
/// values takes registers only.
constexpr size_t kColourSums = 5;
DUET_WIDE void add_colours(const double* sample, std::span<const float> weights, float factor,
                           double* __restrict coarse, double* __restrict fine) {
  std::array<double, kColourSums> values;
  std::copy_n(sample, kColourSums, values.begin());
  for (size_t p = 0; p < weights.size(); ++p, coarse += kColourSums, fine += kColourSums) {
    const auto weight = double(weights[p] * factor);
    for (size_t c = 0; c < kColourSums; ++c) add_parts(weight * values[c], coarse[c], fine[c]);
  }
}

}  // namespace

SampleAdder::SampleAdder(const Film& film, FilmTile& tile)
    : filter_(film.filter()),
      limit_(film.sample_limit()),
      tile_(tile),
      sample_(tile.stride_, 1.0),
      weighted_(tile.stride_ * kMostPixelsInReach),
      coarse_(tile.sums_.size()),
      fine_(tile.sums_.size()) {}

void SampleAdder::take(std::span<const float> values) {
  if (added_ == kSamplesAtATime) {
    move_to_tile();
    std::fill(coarse_.begin(), coarse_.end(), 0.0);
    std::fill(fine_.begin(), fine_.end(), 0.0);
    added_ = 0;
  }
  ++added_;
  // A known number of values takes no loop.
  double* const copies = sample_.data() + 1;
  is_large_ =
      !(values.size() == kColourSums - 1 ? copy_small(values.first<kColourSums - 1>(), copies)
                                         : copy_small(values, copies));
  if (limit_) {
    const auto share = double(limit_->share(values.data()));
    for (size_t c = 1; c <= 3; ++c) sample_[c] *= share;
    is_large_ = false;
    for (const double v : sample_) is_large_ |= !(std::abs(v) < kSmall);
  }
}

inline void SampleAdder::add_to_pixel(size_t at) {
  if (is_large_ || sample_.size() != kColourSums) {
    constexpr float kOne = 1;
    add(at, std::span(&kOne, 1), 1);
    return;
  }
  const double* const sample = sample_.data();
  double *const coarse = &coarse_[at], *const fine = &fine_[at];
  for (size_t c = 0; c < kColourSums; ++c) add_parts(sample[c], coarse[c], fine[c]);
}

void SampleAdder::add(size_t at, std::span<const float> weights, float factor) {
  double *const coarse = &coarse_[at], *const fine = &fine_[at];
  if (is_large_) {
    ExactSum* sum = &tile_.sums_[at];
    for (const float w : weights)
      for (const double v : sample_) (sum++)->add(double(w * factor) * v);
  } else if (sample_.size() == kColourSums) {
    add_colours(sample_.data(), weights, factor, coarse, fine);
  } else {
    add_row(sample_, weights, factor, weighted_.data(), coarse, fine);
  }
}

void SampleAdder::add(int x, int y, const Point2f& position, std::span<const float> values) {
  take(values);
  if (filter_.is_unit_box()) {
    if (tile_.stored().contains(x, y)) add_to_pixel(tile_.index(x, y));
    return;
  }
  for_reached_rows(filter_, position, tile_.stored(),
                   [&](int x0, int y0, std::span<const float> wx, float wy) {
                     add(tile_.index(x0, y0), wx, wy);
                   });
}

void SampleAdder::move_to_tile() {
  // A pixel whose weights are all one has no samples if their sum is zero.
  const size_t step = filter_.is_unit_box() ? tile_.stride_ : 1;
  for (size_t first = 0; first < coarse_.size(); first += step) {
    if (coarse_[first] == 0 && fine_[first] == 0) continue;
    for (size_t i = first; i < first + step; ++i)
      tile_.sums_[i].add_units(std::llrint(coarse_[i] * 0x1p32), std::llrint(fine_[i] * 0x1p64));
  }
}

}  // namespace duet
