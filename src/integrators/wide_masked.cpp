// What batches do at points of masks: see Mask.
#include "integrators/wide_stages.h"
#include "materials/wrappers.h"

namespace duet {

void WideStages::list_masked_points() {
  masked_.clear();
  const auto list = [this](int i, const Surface& at) {
    const uint32_t shape = hits_.shape[i];
    if (!wide_.shapes[shape].masked) return;
    const float share = wide_.masks[shape]->share(at);
    if (share < 1) masked_.push_back({i, share, false});
  };
  for (size_t k = 0; k < special_.size(); ++k) list(special_[k], surfaces_[k]);
  for (size_t k = 0; k < textured_.size(); ++k) list(textured_[k], textured_points_[k]);
}

void WideStages::choose_at_masks() {
  if (wide_.masks.empty()) return;
  list_masked_points();
  for (MaskedPoint& p : masked_) {
    float& u = numbers_.first[p.point];
    p.passes = u >= p.share;
    // Where nothing lies below nothing is chosen, and the number is that of roulette.
    if (!p.passes) u = std::min(u / p.share, kBelowOne);
  }
}

void WideStages::shade_masked_points() {
  if (wide_.masks.empty()) return;
  for (const MaskedPoint& p : masked_) {
    const int i = p.point;
    lights_.value.set(i, lights_.value.vector(i) * p.share);
    lights_.bsdf_pdf[i] *= p.share;
    scattering_.roulette[i] = p.share > 0 ? numbers_.second[i] : numbers_.first[i];
    if (!p.passes) {
      scattering_.pdf[i] *= p.share;  // delta lobes' stay below zero
      continue;
    }
    scattering_.wi.set(i, paths_.ray.direction.vector(i));
    scattering_.weight.set(i, 1, 1, 1);
    scattering_.pdf[i] = -1;
    scattering_.eta[i] = 1;
    scattering_.alive[i] = scattering_.null[i] = 1;
  }
}

}  // namespace duet
