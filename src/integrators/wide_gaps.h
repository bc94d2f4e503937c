// Closes the gaps that elements leave which are done with.
#pragma once

#include "integrators/wide_state.h"

namespace duet {

/// Moves that fill the places of elements that go with elements from behind: so many as there are
/// gaps, and none where nothing goes. The order that comes of it is another, but always the same.
class WideGaps {
 public:
  /// `stays(i)` is 1 for the elements among the first `n` that stay, else 0. Returns their number.
  template <class F>
  int find(int n, F&& stays) {
    int staying = 0;
    for (int i = 0; i < n; ++i) staying += stays(i);
    // Without branches: which elements go cannot be predicted.
    int gaps = 0, movers = 0;
    for (int i = 0; i < staying; ++i) {
      to_[gaps] = i;
      gaps += 1 - stays(i);
    }
    for (int i = staying; i < n; ++i) {
      from_[movers] = i;
      movers += stays(i);
    }
    count_ = gaps;
    return staying;
  }

  void fill(WidePaths& p) const {
    fill(p.ray);
    fill(p.throughput);
    fill(p.bsdf_pdf);
    fill(p.from);
    fill(p.eta);
    fill(p.id);
    fill(p.keys.high);
    fill(p.keys.low);
  }
  void fill(HitBatch& h) const {
    fill(h.t);
    fill(h.u);
    fill(h.v);
    fill(h.primitive);
    fill(h.shape);
    fill(h.instance);
  }
  void fill(WideShadowRays& s) const {
    fill(s.ray);
    fill(s.contribution);
    fill(s.id);
  }
  template <class T>
  void fill(BatchArray<T>& a) const {
    for (int k = 0; k < count_; ++k) a[to_[k]] = a[from_[k]];
  }

 private:
  void fill(BatchTriples& a) const {
    fill(a.x);
    fill(a.y);
    fill(a.z);
  }
  void fill(RayBatch& r) const {
    fill(r.origin);
    fill(r.direction);
    fill(r.tmax);
  }

  int count_ = 0;
  BatchArray<int32_t> to_{}, from_{};
};

}  // namespace duet
