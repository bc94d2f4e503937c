#include "image/film_tile.h"

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

PixelBounds PixelBounds::intersect(const PixelBounds& o) const {
  return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
}

float SampleLimit::share(const float* rgb) const {
  double largest = 0;
  for (const auto& row : sensor)
    largest = std::max(largest,
                       row[0] * double(rgb[0]) + row[1] * double(rgb[1]) + row[2] * double(rgb[2]));
  return largest > most ? float(most / largest) : 1.0f;
}

FilmTile::FilmTile(const PixelBounds& sampled, const PixelBounds& stored, int channels,
                   const std::optional<SampleLimit>& limit)
    : sampled_(sampled),
      stored_(stored),
      stride_(size_t(channels) + 1),
      limit_(limit),
      sums_(size_t(stored.width()) * size_t(stored.height()) * stride_) {}

void FilmTile::add(const FilmTile& o) {
  samples_ += o.samples_;
  for (size_t i = 0; i < sums_.size(); ++i) sums_[i].add(o.sums_[i]);
}

void FilmTile::clear() {
  samples_ = 0;
  std::fill(sums_.begin(), sums_.end(), ExactSum());
}

SampleAdder::SampleAdder(FilmTile& tile)
    : tile_(tile),
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
  if (tile_.limit_) {
    const auto share = double(tile_.limit_->share(values.data()));
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

void SampleAdder::add_to_pixel(int x, int y, std::span<const float> values) {
  if (!tile_.stored_.contains(x, y)) return;
  constexpr float kOne = 1;
  take(values);
  add(tile_.index(x, y), std::span(&kOne, 1), 1);
}

void SampleAdder::add_sample(const ReconstructionFilter& filter, const Point2f& p,
                             std::span<const float> values) {
  take(values);
  for_reached_rows(
      filter, p, tile_.stored_,
      [&](int x0, int y, std::span<const float> wx, float wy) { add(tile_.index(x0, y), wx, wy); });
}

void SampleAdder::move_to_tile() {
  for (size_t i = 0; i < coarse_.size(); ++i)
    tile_.sums_[i].add_units(std::llrint(coarse_[i] * 0x1p32), std::llrint(fine_[i] * 0x1p64));
}

}  // namespace duet
