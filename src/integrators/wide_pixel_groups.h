// Paths of a batch that use one another's second vertices.
#pragma once

#include <vector>

#include "integrators/wide_glossy.h"
#include "integrators/wide_scene.h"
#include "integrators/wide_walk.h"

namespace duet {

/// Groups of a batch's pixels, drawn anew for every sample. What a diffuse second vertex scatters
/// is the same in all directions, and that of the base of a plastic but for a known factor: it is
/// estimated by the path that has found it and counts for all pixels of the group whose first
/// vertices see it, with the balance heuristic over the paths that could have found it. Unbiased;
/// the noise of a pixel is that of many paths, and has a part in common with that of the others.
/// Source: Bekaert, Sbert & Halton, "Accelerating Path Tracing by Re-Using Paths", 2002;
/// docs/pixel_groups.md.
class WidePixelGroups {
 public:
  /// `members` pixels at most in a group.
  WidePixelGroups(const WideScene& scene, bool strict_normals, int members);

  /// What the batch's paths are at.
  struct Vertices {
    const HitBatch& hits;
    const WidePoints& points;
  };
  /// Begins a sample of `count` pixels; the groups follow from the key.
  void start(int count, uint64_t key);
  /// Notes the first vertices of the first `n` paths.
  void note_first(int n, const WidePaths& paths, const Vertices& at);
  /// Notes the second ones. Those that are shared carry a grey throughput from then on, and what
  /// their paths find beyond is to be given to add().
  void note_second(int n, WidePaths& paths, const Vertices& at);
  /// Says that what the second vertices scatter of these light samples is to be added next, or of
  /// light from the next directions: how much of it is scattered by bases.
  void set_shares(const WideVertices& at, const WideLightSamples& samples);
  void set_shares(const WideVertices& at, const WideScattering& next);
  /// Whether the second vertex of a pixel's path is shared.
  bool shares(int id) const { return second_.side[place_[size_t(id)]] != 0; }
  /// What only the pixel itself can use of it goes to `own`.
  void add(int id, const Spectrum& s, WideSamples& own) {
    const int k = place_[size_t(id)];
    const Spectrum shared = s * color_at(second_.share, k);
    scattered_.add(k, shared);
    own.add(id, (s - shared) * color_at(second_.tint, k));
  }
  /// Adds to each pixel what the second vertices of its group scatter towards its first.
  void add_to(WideSamples& samples, RenderCounters& counters);

 private:
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
    BatchTriples share;        ///< of what is added that the base scatters; 1 of diffuse surfaces
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

  /// `value(i)` is the BSDF at point i for its direction, 0 for delta lobes.
  template <class F>
  void set_base_shares(const WideVertices& at, const BatchTriples& towards, F&& value);
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
  /// Adds what the second vertices of the first `n` pairs scatter.
  void flush(int n, WideSamples& samples, RenderCounters& counters);

  const WideScene& wide_;
  bool strict_normals_;
  int members_, count_ = 0;
  std::vector<int> place_;  ///< of each pixel
  std::vector<int> pixel_;  ///< at each place
  First first_{};
  Second second_{};
  WideSamples scattered_{};  ///< by second vertices, times `scale`
  std::vector<Shared> shared_;
  Pairs pairs_{};
  WideShadowRays shadows_{};
  WideGlossy glossy_{};
  WideNumbers numbers_{};  ///< of which evaluation needs none
  std::vector<std::vector<int>> glossy_pairs_;
  /// Paths of the batch whose second vertices are plastics, by WideShape::number.
  std::vector<std::vector<int>> plastics_;
  std::vector<bool> is_plastic_;  ///< by WideShape::number
};

}  // namespace duet
