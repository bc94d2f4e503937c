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

DUET_WIDEST void WideEyeGroups::find_ratios(int n, const Target& target, const Pairs& pairs,
                                            const First& first, const BatchArray<float>& first_vcm,
                                            Weighed& out) {
  const Point3f position = target.position;
  const float own = target.outset > 0 ? 1 / target.outset : 0.0f, connects = target.connects;
  const int begin = target.pairs;
  DUET_LANES
  for (int m = 0; m < n; ++m) {
    const int k = begin + m, i = pairs.first[k];
    const Vector3f d = pairs.direction.vector(k), ng = first.points.ng.vector(i);
    const float r2 = length_squared(position - first.points.position.point(i));
    const float pdf = pairs.pdf[k];
    const float before = std::abs(dot(ng, d)) * first_vcm[i] / r2;
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

void WideEyeGroups::add_to(WideSamples& samples, RenderCounters& counters) {
  const auto add = [&](int j, int begin, int end, float scale) {
    const int n = end - begin;
    const float outset = own_outset_[j] * float(members_);
    find_ratios(n, {second_.points.position.point(j), outset, begin, connects_}, pairs_, first_,
                first_vcm_, weighed_);
    for (int f = last_found_[j]; f >= 0; f = found_[size_t(f)].next)
      add_weighed(n, found_[size_t(f)], weighed_);
    for (int m = 0; m < n; ++m) {
      const int k = begin + m;
      if (!(pairs_.pdf[k] > 0)) continue;
      const Spectrum found(weighed_.r[m], weighed_.g[m], weighed_.b[m]);
      samples.add(pixel_[size_t(pairs_.first[k])], found * scale * color_at(pairs_.value, k));
    }
  };
  for_each_shared(
      counters, [&](int j) { return last_found_[j] >= 0; }, add);
}

}  // namespace duet
