#include "math/sampler.h"

namespace duet {

void Sampler::draw_group(uint32_t group) {
  group_ = group;
  select_block(group / (kSobolDimensions / kSobolGroup));
  scramble_group(row_, uint32_t(key_ >> 32), kSobolGroup * group, numbers_.data());
}

void Sampler::select_block(uint32_t block) {
  if (block == block_) return;
  block_ = block;
  row_ = sobol_row(block == 0 ? index_ : shuffled_point(index_, uint32_t(key_), block));
}

}  // namespace duet
