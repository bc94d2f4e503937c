// Paths of a batch that use one another's second vertices.
#pragma once

#include <vector>

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
  /// Calls `add(j, begin, end, scale)` for the shared vertices j for which `has_found(j)`: the
  /// pairs from `begin` to `end` are those with the first vertices of the group, of which the ones
  /// with a density count. What the path of j has found is to be multiplied by `scale` and by the
  /// value of the pair.
  template <class Has, class Add>
  void for_each_shared(RenderCounters& counters, const Has& has_found, const Add& add);

  struct Span {
    int begin, size;
  };
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
    BatchArray<float> cosine;           ///< with the shading normal, on the lit side
    BatchArray<float> geometry;         ///< area measure over solid angle; 0 where one faces away
    BatchArray<float> cosine_seen;      ///< at the second vertex
    BatchArray<float> seen;             ///< see_bases(); 1 of diffuse surfaces
    RayBatch ray;
    BatchArray<float> pdf;  ///< of the second vertex, per area; 0 if it is not seen
    BatchTriples value;     ///< BSDF, cosine and geometry
  };
  /// A second vertex and where its pairs begin.
  struct Shared {
    int place, pairs;
  };

  const WideScene& wide_;
  const int members_;
  int count_ = 0;
  std::vector<int> pixel_;  ///< at each place
  First first_{};
  Second second_{};
  Pairs pairs_{};
  WideGlossy glossy_{};
  /// Paths of the batch whose second vertices are plastics, by WideShape::number.
  std::vector<std::vector<int>> plastics_;

 private:
  int group_begin(int place) const { return place / members_ * members_; }
  int group_size(int place) const { return std::min(members_, count_ - group_begin(place)); }
  /// The pairs of a second vertex with all first ones of its group, as pairs `at` and following.
  static void find_pairs(const First& first, const Second& second, int place, Span group, int at,
                         Pairs& pairs);
  /// Densities and values of the first `n` pairs.
  void evaluate(int n);
  void evaluate_glossy_pairs();
  /// Multiplies pairs by how the second vertices are seen from the first ones.
  void see_plastics();
  void test(int n, RenderCounters& counters);
  /// Calls `add` for the vertices of the first `n` pairs.
  template <class Add>
  void flush(int n, RenderCounters& counters, const Add& add);

  bool strict_normals_;
  std::vector<int> place_;  ///< of each pixel
  std::vector<Shared> shared_;
  WideShadowRays shadows_{};
  WideNumbers numbers_{};  ///< of which evaluation needs none
  std::vector<std::vector<int>> glossy_pairs_;
  std::vector<bool> is_shared_plastic_;  ///< by WideShape::number
};

template <class Add>
void WidePixelGroups::flush(int n, RenderCounters& counters, const Add& add) {
  evaluate(n);
  test(n, counters);
  for (const Shared& s : shared_) {
    const int end = s.pairs + group_size(s.place);
    float sum = 0;
    for (int k = s.pairs; k < end; ++k) sum += pairs_.pdf[k];
    if (sum > 0) add(s.place, s.pairs, end, 1 / (sum * second_.scale[s.place]));
  }
  shared_.clear();
}

template <class Has, class Add>
void WidePixelGroups::for_each_shared(RenderCounters& counters, const Has& has_found,
                                      const Add& add) {
  int n = 0;
  for (int j = 0; j < count_; ++j) {
    if (second_.side[j] == 0 || !has_found(j)) continue;
    const Span group{group_begin(j), group_size(j)};
    if (n + group.size > kBatch) flush(n, counters, add), n = 0;
    find_pairs(first_, second_, j, group, n, pairs_);
    for (int k = 0; k < group.size; ++k)
      pairs_.first[n + k] = group.begin + k, pairs_.second[n + k] = j;
    shared_.push_back({j, n});
    n += group.size;
  }
  flush(n, counters, add);
}

}  // namespace duet
