// Random numbers by index: (seed, pixel, sample, dimension) → number, so that any sample of any
// pixel can be made anywhere and at any time.
#pragma once

#include <array>
#include <cstdint>

#include "math/hash.h"
#include "math/sobol.h"
#include "math/vector.h"

namespace duet {

/// Which numbers a sampler hands out.
enum class SampleSequence {
  independent,  ///< hashed counters: statistically independent samples
  sobol,        ///< Owen-scrambled Sobol' points, scrambled anew for every pixel
};

/// What tells the dimensions of independent samples apart.
constexpr uint64_t dimension_salt(uint32_t dimension) {
  return 0x9e3779b97f4a7c15ull * (dimension + 1);
}

/// The random numbers of the samples of one pixel, handed out dimension by dimension.
/// Numbers lie in [0, 1).
class Sampler {
 public:
  /// `pixel` identifies the pixel within the full image (never within a crop or a tile); `scramble`
  /// is the number of the batch: batches of one seed are independent of one another.
  Sampler(SampleSequence sequence, uint64_t seed, uint32_t scramble, uint64_t pixel)
      : sequence_(sequence), pixel_key_(hash_combine(hash_combine(seed, scramble), pixel)) {}

  /// Continues at dimension 0 of the sample with this index.
  void start_sample(uint32_t index) {
    dimension_ = 0;
    if (sequence_ == SampleSequence::independent) {
      key_ = mix64(pixel_key_ + index);
      return;
    }
    index_ = index & ((1u << kSobolIndexBits) - 1);
    // A sequence that is used up goes on with a new scramble.
    const uint32_t round = index >> kSobolIndexBits;
    key_ = round == 0 ? pixel_key_ : hash_combine(pixel_key_, round);
    block_ = 0;
    row_ = sobol_row(index_);
    group_ = kNoGroup;
  }

  /// Continues at the given dimension: each vertex of a path has dimensions of its own, so that
  /// what one vertex uses does not shift the numbers of the next.
  void start_dimension(uint32_t d) { dimension_ = d; }

  [[gnu::always_inline]] float next_1d() {
    const uint32_t d = dimension_++;
    if (sequence_ == SampleSequence::independent) return to_unit_float(uint32_t(draw(d) >> 32));
    return scrambled(d);
  }

  [[gnu::always_inline]] Point2f next_2d() {
    const uint32_t d = dimension_;
    dimension_ += 2;
    if (sequence_ == SampleSequence::independent) {
      const uint64_t bits = draw(d);
      return {to_unit_float(uint32_t(bits >> 32)), to_unit_float(uint32_t(bits))};
    }
    const float x = scrambled(d);
    return {x, scrambled(d + 1)};
  }

 private:
  uint64_t draw(uint32_t d) const { return mix64(key_ + dimension_salt(d)); }

  float scrambled(uint32_t d) {
    if (d / kSobolGroup != group_) draw_group(d / kSobolGroup);
    return numbers_[d % kSobolGroup];
  }

  /// Makes the numbers of a group of dimensions.
  void draw_group(uint32_t group);
  /// Dimensions come in blocks of kSobolDimensions; later blocks use the same points in another
  /// order that is itself an Owen scramble, so each prefix of the sequence stays well distributed.
  /// Source: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
  void select_block(uint32_t block);

  static constexpr uint32_t kNoGroup = ~0u;

  SampleSequence sequence_;
  uint32_t index_ = 0;
  uint32_t dimension_ = 0;
  uint64_t pixel_key_;
  uint64_t key_ = 0;
  /// Of Sobol' points, the numbers of the group of dimensions that was asked for last: a vertex of
  /// a path needs about as many, and together they cost little more than one.
  uint32_t group_ = kNoGroup, block_ = 0;
  SobolRow row_;  ///< of the block of dimensions
  std::array<float, kSobolGroup> numbers_;
};

}  // namespace duet
