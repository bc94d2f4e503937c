#include "integrators/wide_path_groups.h"

#include <algorithm>

#include "base/instruction_sets.h"
#include "integrators/wide_plastic.h"

namespace duet {

void WidePathGroups::start(int count, uint64_t key) {
  WidePixelGroups::start(count, key);
  scattered_ = {};
}

void WidePathGroups::note_second(int n, WidePaths& paths, const Vertices& at) {
  WidePixelGroups::note_second(n, paths, at);
  for (int i = 0; i < n; ++i) share_.set(place(paths.id[i]), 1, 1, 1);
}

template <class F>
void WidePathGroups::set_base_shares(const WideVertices& at, const BatchTriples& towards,
                                     F&& value) {
  for (size_t number = 0; number < plastics_.size(); ++number) {
    const std::vector<int>& list = plastics_[number];
    if (list.empty()) continue;
    const int n = int(list.size());
    for (int k = 0; k < n; ++k) {
      glossy_.at[k] = list[size_t(k)];
      glossy_.towards.set(k, towards.vector(list[size_t(k)]));
    }
    const auto evaluate_base = [&]<class Surface>(Surface base) {
      if constexpr (kHasBase<Surface>) {
        base.plastic.specular_reflectance = Spectrum(0.0f);
        evaluate_glossy(n, base, at, glossy_);
      }
    };
    std::visit(evaluate_base, wide_.glossy[number]);
    for (int k = 0; k < n; ++k) {
      const int i = list[size_t(k)];
      const Vector3f base = glossy_.value.vector(k), all = value(i);
      const auto share = [](float part, float whole) {
        return whole > 0 ? std::min(part / whole, 1.0f) : 0.0f;
      };
      share_.set(place(at.paths.id[i]), share(base.x, all.x), share(base.y, all.y),
                 share(base.z, all.z));
    }
  }
}

void WidePathGroups::set_shares(const WideVertices& at, const WideLightSamples& samples) {
  set_base_shares(at, samples.wi, [&](int i) { return samples.value.vector(i); });
}

void WidePathGroups::set_shares(const WideVertices& at, const WideScattering& next) {
  set_base_shares(at, next.wi,
                  [&](int i) { return next.weight.vector(i) * std::max(next.pdf[i], 0.0f); });
}

DUET_WIDEST void WidePathGroups::add_scattered(const Shared& s, const Pairs& pairs,
                                               const Spectrum& scattered, BatchTriples& sums) {
  const Spectrum color = scattered;
  add_values(s, pairs, sums, [&](int) { return color; });
}

void WidePathGroups::add_to(WideSamples& samples, RenderCounters& counters) {
  const auto has_found = [&](int j) {
    return scattered_.r[j] != 0 || scattered_.g[j] != 0 || scattered_.b[j] != 0;
  };
  const auto add = [&](const Shared& s, float scale) {
    const int j = s.place;
    add_scattered(s, pairs_, Spectrum(scattered_.r[j], scattered_.g[j], scattered_.b[j]) * scale,
                  sums_);
  };
  for_each_shared(counters, has_found, add);
  give_sums(samples);
}

}  // namespace duet
