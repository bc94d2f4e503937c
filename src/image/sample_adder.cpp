#include "image/sample_adder.h"

#include <algorithm>

namespace duet {

namespace {

/// Values of samples below this are added in double precision: with weights of at most two, sums of
/// kSamplesAtATime of them are below 2²¹, so that a multiple of 2⁻³² has no more than 53 bits.
constexpr double kSmall = 32;
constexpr uint32_t kSamplesAtATime = 1u << 14;
/// Adding and subtracting these rounds a small number to a multiple of 2⁻³² and of 2⁻⁶⁴.
constexpr double kCoarse = 0x1.8p20, kFine = 0x1.8p-12;

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
  std::copy(values.begin(), values.end(), sample_.begin() + 1);
  if (limit_) {
    const auto share = double(limit_->share(values.data()));
    for (size_t c = 1; c <= 3; ++c) sample_[c] *= share;
  }
  is_large_ = false;
  for (const double v : sample_) is_large_ |= !(std::abs(v) < kSmall);
}

void SampleAdder::add(size_t at, std::span<const float> weights, float factor) {
  const size_t n = sample_.size(), count = n * weights.size();
  double* next = weighted_.data();
  for (const float w : weights)
    for (size_t c = 0; c < n; ++c) *next++ = double(w * factor) * sample_[c];
  // Three lists that do not overlap, so that several numbers are done at a time.
  const double* const __restrict weighted = weighted_.data();
  if (is_large_) {
    for (size_t i = 0; i < count; ++i) tile_.sums_[at + i].add(weighted[i]);
    return;
  }
  double* const __restrict coarse = &coarse_[at];
  double* const __restrict fine = &fine_[at];
  for (size_t i = 0; i < count; ++i) {
    const double whole = (weighted[i] + kCoarse) - kCoarse;
    coarse[i] += whole;
    fine[i] += ((weighted[i] - whole) + kFine) - kFine;
  }
}

void SampleAdder::add(int x, int y, const Point2f& position, std::span<const float> values) {
  take(values);
  if (filter_.is_unit_box()) {
    constexpr float kOne = 1;
    if (tile_.stored().contains(x, y)) add(tile_.index(x, y), std::span(&kOne, 1), 1);
    return;
  }
  for_reached_rows(filter_, position, tile_.stored(),
                   [&](int x0, int y0, std::span<const float> wx, float wy) {
                     add(tile_.index(x0, y0), wx, wy);
                   });
}

void SampleAdder::move_to_tile() {
  for (size_t i = 0; i < coarse_.size(); ++i)
    tile_.sums_[i].add_units(std::llrint(coarse_[i] * 0x1p32), std::llrint(fine_[i] * 0x1p64));
}

}  // namespace duet
