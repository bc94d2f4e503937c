// Paths of a batch that use one another's second vertices.
#pragma once

#include <vector>

#include "base/instruction_sets.h"
#include "integrators/wide_glossy.h"
#include "integrators/wide_scene.h"
#include "integrators/wide_walk.h"

namespace duet {

/// Groups of a batch's pixels, drawn anew for every sample, and which of their first vertices see
/// which of their second ones. What a diffuse second vertex scatters is the same in all directions,
/// and that of the base of a plastic but for a known factor: it is estimated by the path that has
/// found it and counts for all pixels of the group whose first vertices see it, with the balance
/// heuristic over the paths that could have found it. Unbiased; the noise of a pixel is that of
/// many paths, and has a part in common with that of the others.
/// Source: Bekaert, Sbert & Halton, "Accelerating Path Tracing by Re-Using Paths", 2002;
/// docs/pixel_groups.md.
class WidePixelGroups {
 public:
  /// What the batch's paths are at.
  struct Vertices {
    const HitBatch& hits;
    const WidePoints& points;
  };
  /// Notes the first vertices of the first `n` paths.
  void note_first(int n, const WidePaths& paths, const Vertices& at);
  /// Notes the second ones. Those that are shared carry a grey throughput from then on, and what
  /// their paths find beyond is for the group.
  void note_second(int n, WidePaths& paths, const Vertices& at);
  /// Whether the second vertex of a pixel's path is shared.
  bool shares(int id) const { return second_.side[place(id)] != 0; }

 protected:
  /// `members` pixels at most in a group. Without `bases` plastics are not shared.
  WidePixelGroups(const WideScene& scene, bool strict_normals, int members, bool bases);
  /// Begins a sample of `count` pixels; the groups follow from the key.
  void start(int count, uint64_t key);
  /// Where the pixel's vertices are among those of all groups.
  int place(int id) const { return place_[size_t(id)]; }
  struct Span {
    int begin, size;
  };
  /// A second vertex, the places of its group, and the number of its pair with the first of them:
  /// the others follow.
  struct Shared {
    int place;
    Span group;
    int pairs;
  };
  /// Calls `add(s, scale)` for the shared vertices of which `has_found(place)`. To the sums of its
  /// group is to be added what its path has found, times `scale` and the values of the pairs that
  /// have a density.
  template <class Has, class Add>
  void for_each_shared(RenderCounters& counters, const Has& has_found, const Add& add);
  /// Adds the sums to the pixels.
  void give_sums(WideSamples& samples) const;

  /// Vertices by their places in groups: those of a group follow each other.
  struct First {
    WidePaths paths;  ///< directions of the camera's rays
    WidePoints points;
    BatchArray<float> side;  ///< lit side of diffuse surfaces, 0 of glossy ones and of none
    BatchArray<int32_t>
        list;  ///< −1 without a vertex, 0 of diffuse surfaces, 1 + WideShape::number
  };
  struct Second {
    WidePoints points;
    BatchArray<float> side;    ///< lit side; 0 if there is no such vertex
    BatchArray<int32_t> list;  ///< as of first ones
    BatchArray<float> scale;   ///< throughput up to it
    BatchTriples tint;         ///< the colour of that
  };
  /// Pairs of a first vertex and the second one of a member of its group.
  struct Pairs {
    BatchArray<int32_t> first, second;  ///< places of the vertices
    BatchTriples direction;             ///< unit
    BatchArray<float> geometry;         ///< area measure over solid angle; 0 where one faces away
    BatchArray<float> cosine_seen;      ///< at the second vertex
    BatchArray<float> seen;             ///< see_bases(); 1 of diffuse surfaces
    RayBatch ray;
    BatchArray<float> pdf;  ///< of the second vertex, per area; 0 if it is not seen
    BatchTriples value;     ///< BSDF, cosine and geometry
  };
  /// Adds to the sums, for the m-th pair of `s` that has a density, its value times `color(m)`.
  template <class F>
  [[gnu::always_inline]] static void add_values(const Shared& s, const Pairs& pairs,
                                                BatchTriples& sums, const F& color);

  const WideScene& wide_;
  const int members_;
  First first_{};
  Second second_{};
  Pairs pairs_{};
  BatchTriples sums_{};  ///< what pixels get, by their places
  WideGlossy glossy_{};
  /// Paths of the batch whose second vertices are plastics, by WideShape::number.
  std::vector<std::vector<int>> plastics_;

 private:
  Span group_of(int place) const {
    const int begin = place / members_ * members_;
    return {begin, std::min(members_, count_ - begin)};
  }
  /// The pairs of a second vertex, with the densities and values of diffuse first ones.
  static void find_pairs(const First& first, const Second& second, const Shared& s, Pairs& pairs);
  /// Densities and values of the first `n` pairs, whose first vertices may be glossy.
  void evaluate(int n);
  void evaluate_glossy_pairs(int n);
  /// Multiplies pairs by how the second vertices are seen from the first ones.
  void see_plastics();
  /// With strict normals.
  void drop_two_sided(int n);
  void test(int n, RenderCounters& counters);
  /// Calls `add` for the vertices of the first `n` pairs.
  template <class Add>
  void flush(int n, RenderCounters& counters, const Add& add);

  bool strict_normals_;
  int count_ = 0;
  bool has_glossy_ = false;  ///< among first vertices
  std::vector<int> place_;   ///< of each pixel
  std::vector<int> pixel_;   ///< at each place
  std::vector<Shared> shared_;
  WideShadowRays shadows_{};
  WideNumbers numbers_{};  ///< of which evaluation needs none
  std::vector<std::vector<int>> glossy_pairs_;
  std::vector<bool> is_shared_plastic_;  ///< by WideShape::number
};

template <class F>
inline void WidePixelGroups::add_values(const Shared& s, const Pairs& pairs, BatchTriples& sums,
                                        const F& color) {
  const int n = s.group.size, begin = s.group.begin, at = s.pairs;
  DUET_LANES
  for (int m = 0; m < n; ++m) {
    const Spectrum c = color(m);
    const float seen = pairs.pdf[at + m] > 0 ? 1.0f : 0.0f;
    sums.x[begin + m] += seen * c.r * pairs.value.x[at + m];
    sums.y[begin + m] += seen * c.g * pairs.value.y[at + m];
    sums.z[begin + m] += seen * c.b * pairs.value.z[at + m];
  }
}

template <class Add>
void WidePixelGroups::flush(int n, RenderCounters& counters, const Add& add) {
  evaluate(n);
  test(n, counters);
  for (const Shared& s : shared_) {
    const int end = s.pairs + s.group.size;
    float sum = 0;
    for (int k = s.pairs; k < end; ++k) sum += pairs_.pdf[k];
    if (sum > 0) add(s, 1 / (sum * second_.scale[s.place]));
  }
  shared_.clear();
}

template <class Has, class Add>
void WidePixelGroups::for_each_shared(RenderCounters& counters, const Has& has_found,
                                      const Add& add) {
  int n = 0;
  for (int j = 0; j < count_; ++j) {
    if (second_.side[j] == 0 || !has_found(j)) continue;
    const Span group = group_of(j);
    if (n + group.size > kBatch) flush(n, counters, add), n = 0;
    shared_.push_back({j, group, n});
    find_pairs(first_, second_, shared_.back(), pairs_);
    n += group.size;
  }
  flush(n, counters, add);
}

}  // namespace duet
