// Photons that a batch of eye sub-paths merges.
#include <algorithm>
#include <utility>

#include "integrators/wide_eye.h"

namespace duet {

void WideEye::merge(int n, int depth, Sums& sums, RenderCounters& counters) {
  int count = 0;
  for (int i = 0; i < n; ++i) {
    merged_.set(i, 0, 0, 0);
    if (!merges_at(i)) continue;
    ++counters.merge_queries;
    if (count > kPhotonsAtOnce) merge_listed(std::exchange(count, 0), depth, counters);
    const int first = count;
    const size_t share = list_photons(i, count);
    std::fill(photon_points_.begin() + first, photon_points_.begin() + count, i);
    kernel_[i] = float(share) / (plan_.set.merge_area * plan_.set.light_paths);
  }
  merge_listed(count, depth, counters);
  for (int i = 0; i < n; ++i)
    sums.samples.add(paths_.id[i], {merged_.x[i], merged_.y[i], merged_.z[i]});
}

bool WideEye::merges_at(int i) {
  if (!merging_[size_t(paths_.id[i])] || !carries(i)) return false;
  const PathVertex* const special = special_vertex(i);
  return special ? special->is_smooth() && special->merges() : is_smooth(i);
}

size_t WideEye::list_photons(int i, int& count) {
  uint64_t& random = random_[size_t(paths_.id[i])];
  const auto draw = [&] {
    random = mix64(random + 0x9e3779b97f4a7c15ull);
    return to_unit_float(uint32_t(random >> 32));
  };
  return plan_.photons->list(around_, i, kMostMergedPhotons, draw, photon_entries_.data(), count);
}

void WideEye::merge_listed(int count, int depth, RenderCounters& counters) {
  const LightVertex* const photons = plan_.lights->vertices().vertices.data();
  uint32_t* const indices = photon_entries_.data();
  const int near =
      plan_.photons->select(count, points_.position, indices, photon_points_.data(), indices);
  // They lie anywhere in memory.
  constexpr int kAhead = 16;
  for (int k = 0; k < std::min(kAhead, near); ++k) __builtin_prefetch(photons + indices[k]);
  for (int k = 0; k < near; ++k) {
    __builtin_prefetch(photons + indices[std::min(k + kAhead, near - 1)]);
    const int i = photon_points_[size_t(k)];
    const LightVertex& photon = photons[indices[k]];
    const WideModel model = wide_.shapes[hits_.shape[i]].model;
    if (model == WideModel::other) {
      merge_one(i, photon, depth, counters);
      continue;
    }
    if (limits_.strict_normals && has_two_sides(i, photon.direction_to_previous())) continue;
    const bool glossy = model == WideModel::glossy;
    auto& [list, listed] = near_[glossy];
    const float pixel_area = camera_scale() * subpaths_.vcm[i];
    list.set(listed++, i, photon, photon.partials_below(depth, pixel_area));
    if (listed == kBatch) merge_near(glossy, depth, counters);
  }
  for (const bool glossy : {false, true}) merge_near(glossy, depth, counters);
}

void WideEye::merge_one(int i, const LightVertex& photon, int depth, RenderCounters& counters) {
  if (int(photon.depth) + depth > limits_.max_depth) return;
  const Connection found =
      connect_merge(weights_[1], photon, eye_vertex(i, depth), kernel_[i], limits_.strict_normals);
  if (found.value.is_black()) return;
  ++counters.merges;
  add_merged(i, found.value * found.weight);
}

void WideEye::merge_near(bool glossy, int depth, RenderCounters& counters) {
  const WidePhotons& photons = near_[glossy].photons;
  const int count = std::exchange(near_[glossy].count, 0);
  const TechniqueSet& set = plan_.set;
  const WideMerges merges{paths_,
                          subpaths_,
                          points_,
                          ends_,
                          kernel_,
                          set.connection_term(),
                          set.partly_merged,
                          limits_.max_depth - depth};
  if (glossy) {
    for (int k = 0; k < count; ++k) {
      const int i = eye_bsdfs_.at[k] = photons.point[k];
      eye_bsdfs_.material[k] = wide_.shapes[hits_.shape[i]].pair_list();
      eye_bsdfs_.towards.set(k, decode_direction(photons.u[k], photons.v[k]));
    }
    evaluate_ends_.evaluate(count, {paths_, points_, numbers_}, eye_bsdfs_);
    merge_glossy_photons(count, photons, eye_bsdfs_, merges, near_sums_, near_merged_);
  } else {
    merge_photons(count, photons, merges, near_sums_, near_merged_);
  }
  for (int k = 0; k < count; ++k) {
    counters.merges += uint64_t(near_merged_[k]);
    add_merged(photons.point[k], {near_sums_.x[k], near_sums_.y[k], near_sums_.z[k]});
  }
}

}  // namespace duet
