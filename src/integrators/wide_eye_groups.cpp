#include "integrators/wide_eye_groups.h"

#include <algorithm>

#include "base/instruction_sets.h"

namespace duet {

namespace {

/// Beyond this an outset is infinite as far as weights go, and can still be divided.
constexpr float kLargestOutset = 1e25f;

}  // namespace

void WideEyeGroups::start(int count, uint64_t key) {
  WidePixelGroups::start(count, key);
  found_.clear();
  std::fill_n(last_found_.begin(), count, -1);
}

void WideEyeGroups::note_first(int n, const WidePaths& paths, const Vertices& at,
                               const WideSubpaths& subpaths) {
  WidePixelGroups::note_first(n, paths, at);
  for (int i = 0; i < n; ++i) first_vcm_[place(paths.id[i])] = subpaths.vcm[i];
}

void WideEyeGroups::count_paths(int n, const WidePaths& paths, WideSubpaths& subpaths,
                                WideEnds& ends) {
  const float each = 1 / float(members_);
  for (int i = 0; i < n; ++i) {
    if (!shares(paths.id[i])) continue;
    subpaths.vcm[i] *= each;
    subpaths.vc[i] *= each;
    ends.sum[i] *= each;
    const float outset =
        std::min(subpaths.vcm[i] + ends.reverse[i] * subpaths.vc[i], kLargestOutset);
    own_outset_[place(paths.id[i])] = outset;
    subpaths.vm[i] = outset / ends.reverse[i];
  }
}

void WideEyeGroups::add(int id, const Spectrum& s, float varying) {
  const int j = place(id);
  found_.push_back({s, varying, last_found_[j]});
  last_found_[j] = int(found_.size()) - 1;
}

DUET_WIDEST void WideEyeGroups::begin_weighing(const Shared& s, const Target& target,
                                               const Pairs& pairs, const Firsts& firsts,
                                               Weighed& out) {
  const Point3f position = target.position;
  const float own = target.outset > 0 ? 1 / target.outset : 0.0f, connects = target.connects;
  const WidePoints& points = firsts.at.points;
  const int n = s.group.size, begin = s.group.begin, at = s.pairs;
  DUET_LANES
  for (int m = 0; m < n; ++m) {
    const int k = at + m, i = begin + m;
    const Vector3f d = pairs.direction.vector(k), ng = points.ng.vector(i);
    const float r2 = length_squared(position - points.position.point(i));
    const float pdf = pairs.pdf[k];
    const float before = std::abs(dot(ng, d)) * firsts.vcm[i] / r2;
    const float outset = (connects + pairs.cosine_seen[k] * kInvPi * before) / pdf;
    const float ratio = std::min(outset, kLargestOutset) * own;
    out.ratio[m] = pdf > 0 ? ratio : 1.0f;
    out.r[m] = out.g[m] = out.b[m] = 0;
  }
}

DUET_WIDEST void WideEyeGroups::add_weighed(int n, const Found& found, Weighed& sums) {
  const float r = found.value.r, g = found.value.g, b = found.value.b, varying = found.varying;
  DUET_LANES
  for (int m = 0; m < n; ++m) {
    const float weight = 1 / (1 + varying * (sums.ratio[m] - 1));
    sums.r[m] += r * weight;
    sums.g[m] += g * weight;
    sums.b[m] += b * weight;
  }
}

DUET_WIDEST void WideEyeGroups::end_weighing(const Shared& s, float scale, const Pairs& pairs,
                                             const Weighed& weighed, BatchTriples& sums) {
  add_values(s, pairs, sums, [&](int m) {
    return Spectrum(weighed.r[m] * scale, weighed.g[m] * scale, weighed.b[m] * scale);
  });
}

void WideEyeGroups::add_to(WideSamples& samples, RenderCounters& counters) {
  const auto add = [&](const Shared& s, float scale) {
    const int j = s.place;
    begin_weighing(s,
                   {second_.points.position.point(j), own_outset_[j] * float(members_), connects_},
                   pairs_, {first_, first_vcm_}, weighed_);
    for (int f = last_found_[j]; f >= 0; f = found_[size_t(f)].next)
      add_weighed(s.group.size, found_[size_t(f)], weighed_);
    end_weighing(s, scale, pairs_, weighed_, sums_);
  };
  for_each_shared(
      counters, [&](int j) { return last_found_[j] >= 0; }, add);
  give_sums(samples);
}

}  // namespace duet
