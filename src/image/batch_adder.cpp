#include "image/batch_adder.h"

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

constexpr int kSide = BatchFootprints::kSide;
static_assert(kSide == Film::kTileSize);

/// What is below this goes into the sums of batches: with weights of at most two, those of
/// kBatchesAtATime are below 2¹⁹, so that they keep multiples of 2⁻³².
constexpr float kSmall = 32;
constexpr int kBatchesAtATime = 160;
static_assert(2 * double(kSmall) * kBatchesAtATime * BatchFootprints::kMostWeights *
                  BatchFootprints::kMostWeights <
              0x1p19);

bool is_small(float v) {
  return std::abs(v) < kSmall;
}

/// How many pixels beyond its own a sample can reach. That rounding moves a sample by some part of
/// a pixel makes no difference.
int reach(const FilterProfile& filter) {
  return std::max(1, int(filter.radius() + 0.75f));
}

/// Weights of a row of samples at these positions for one pixel each: `pixel`, and `step` more for
/// each further one. For SSE2: the processors' instructions that gather took twice the time.
void weigh(const FilterProfile& filter, const float* positions, int pixel, int step,
           float* weights) {
  const float r = filter.radius();
  DUET_LANES
  for (int i = 0; i < kSide; ++i) {
    const auto x = float(pixel + step * i);
    const float p = positions[i], w = filter.weight_in_lanes(x + 0.5f - p);
    // The bounds that for_reached_rows has.
    const bool reached = (x >= p - r - 0.5f) & (x <= p + r - 0.5f);
    weights[i] = reached ? w : 0.0f;
  }
}

/// Copies a row of values, without those that are too large; whether there are such.
bool place(const float* values, double* to) {
  int large = 0;
  DUET_LANES
  for (int i = 0; i < kSide; ++i) {
    to[i] = is_small(values[i]) ? double(values[i]) : 0.0;
    large |= is_small(values[i]) ? 0 : 1;
  }
  return large != 0;
}

/// Whether those of a row that count are all one.
bool are_ones(const float* values, const std::array<int, kSide>& counts) {
  int others = 0;
  for (int i = 0; i < kSide; ++i) others |= values[i] != 1 ? counts[size_t(i)] : 0;
  return others == 0;
}

DUET_WIDEST void add_lanes(const BatchFootprints& batch, bool is_opaque,
                           BatchSums<ExactBatchSums>& sums) {
  switch (batch.reach_x) {
    case 1:
      return add_batch<3>(batch, is_opaque, sums);
    case 2:
      return add_batch<5>(batch, is_opaque, sums);
    case 3:
      return add_batch<7>(batch, is_opaque, sums);
  }
}

}  // namespace

bool BatchAdder::suits(const Film& film) {
  const ReconstructionFilter& filter = film.filter();
  return film.channels() == std::vector<std::string>{"R", "G", "B", "A"} && !film.sample_limit() &&
         !filter.is_unit_box() &&
         std::max(reach(filter.along_x()), reach(filter.along_y())) <= BatchFootprints::kMostReach;
}

BatchAdder::BatchAdder(const Film& film, FilmTile& tile, const PixelBounds& square)
    : film_(film),
      tile_(tile),
      square_(square),
      batch_(std::make_unique<BatchFootprints>()),
      sums_(std::make_unique<BatchSums<ExactBatchSums>>()) {
  const PixelBounds b = square.intersect(tile.sampled());
  sampled_ = {b.x0 - square.x0, b.y0 - square.y0, b.x1 - square.x0, b.y1 - square.y0};
  std::fill(counts_.begin() + sampled_.x0, counts_.begin() + sampled_.x1, 1);
  batch_->reach_x = reach(film.filter().along_x());
  batch_->reach_y = reach(film.filter().along_y());
  clear();
}

void BatchAdder::add(const BatchSamples& samples) {
  if (added_ == kBatchesAtATime) {
    move_to_tile();
    clear();
  }
  ++added_;
  const bool opaque = is_opaque(samples);
  for (int row = sampled_.y0; row < sampled_.y1; ++row) place_row(samples, row, opaque);
  (opaque ? has_opaque_ : has_holes_) = true;
  add_lanes(*batch_, opaque, *sums_);
}

void BatchAdder::place_row(const BatchSamples& samples, int row, bool opaque) {
  const int from = row * square_.width(), to = batch_->index(0, row);
  const ReconstructionFilter& filter = film_.filter();
  for (int k = 0; k <= 2 * batch_->reach_x; ++k)
    weigh(filter.along_x(), &samples.x[from], square_.x0 + k - batch_->reach_x, 1,
          &batch_->weights_x[k][to]);
  for (int k = 0; k <= 2 * batch_->reach_y; ++k)
    weigh(filter.along_y(), &samples.y[from], square_.y0 + row + k - batch_->reach_y, 0,
          &batch_->weights_y[k][to]);
  for (int k = 0; k <= 2 * batch_->reach_x; ++k) {
    float* const weights = &batch_->weights_x[k][to];
    std::fill(weights, weights + sampled_.x0, 0.0f);
    std::fill(weights + sampled_.x1, weights + kSide, 0.0f);
  }
  const BatchArray<float>* const colours[] = {&samples.r, &samples.g, &samples.b};
  // Also outside of the columns that are sampled, which makes no difference.
  bool has_large = !opaque && place(&samples.alpha[from], &batch_->alpha[to]);
  for (int c = 0; c < BatchFootprints::kColours; ++c)
    has_large |= place(&(*colours[c])[from], &batch_->colours[c][to]);
  if (has_large) add_large(samples, row);
}

void BatchAdder::add_large(const BatchSamples& samples, int row) {
  for (int column = sampled_.x0; column < sampled_.x1; ++column) {
    const int i = row * square_.width() + column;
    const float values[]{samples.r[i], samples.g[i], samples.b[i], samples.alpha[i]};
    if (std::all_of(std::begin(values), std::end(values), is_small)) continue;
    const int at = batch_->index(column, row);
    for (int k = 0; k <= 2 * batch_->reach_x; ++k) batch_->weights_x[k][at] = 0;
    if (!large_) large_.emplace(film_, tile_);
    large_->add(square_.x0 + column, square_.y0 + row, {samples.x[i], samples.y[i]}, values);
  }
}

bool BatchAdder::is_opaque(const BatchSamples& samples) const {
  bool opaque = true;
  for (int row = sampled_.y0; row < sampled_.y1; ++row)
    opaque &= are_ones(&samples.alpha[row * square_.width()], counts_);
  return opaque;
}

void BatchAdder::clear() {
  added_ = 0;
  has_opaque_ = has_holes_ = false;
  const auto clear_one = [](ExactBatchSums& s) {
    std::fill(std::begin(s.coarse), std::end(s.coarse), ExactBatchSums::kCoarse);
    std::fill(std::begin(s.fine), std::end(s.fine), uint64_t(0));
  };
  for (ExactBatchSums* s : {&sums_->opaque_weight, &sums_->weight, &sums_->alpha}) clear_one(*s);
  for (ExactBatchSums& s : sums_->colours) clear_one(s);
}

void BatchAdder::move_to_tile() {
  const int rx = batch_->reach_x, ry = batch_->reach_y;
  const PixelBounds reached{square_.x0 - rx, square_.y0 - ry, square_.x1 + rx, square_.y1 + ry};
  const PixelBounds stored = tile_.stored().intersect(reached);
  const std::span<ExactSum> all = tile_.sums();
  const auto move = [](const ExactBatchSums& from, int i, ExactSum& to) {
    to.add_units(from.coarse_units(i), from.fine_units(i));
  };
  for (int y = stored.y0; y < stored.y1; ++y)
    for (int x = stored.x0; x < stored.x1; ++x) {
      const int i = (y - reached.y0) * batch_->pitch() + x - reached.x0;
      const std::span<ExactSum> pixel = all.subspan(tile_.index(x, y), 5);
      for (size_t c = 0; c < 3; ++c) move(sums_->colours[c], i, pixel[1 + c]);
      if (has_opaque_)
        for (const size_t to : {0, 4}) move(sums_->opaque_weight, i, pixel[to]);
      if (has_holes_) move(sums_->weight, i, pixel[0]), move(sums_->alpha, i, pixel[4]);
    }
}

}  // namespace duet
