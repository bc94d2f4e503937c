// Eye sub-paths of many pixels at once, stage by stage.
#pragma once

#include "integrators/wide_end_bsdfs.h"
#include "integrators/wide_eye_groups.h"
#include "integrators/wide_eye_kernels.h"
#include "integrators/wide_merge_kernels.h"
#include "integrators/wide_subpath_stages.h"
#include "integrators/wide_walk.h"
#include "transport/drawn_vertices.h"
#include "transport/light_pass.h"
#include "transport/subpath_sharing.h"
#include "transport/vertex_grid.h"

namespace duet {

/// Of the iteration under way, what its eye sub-paths are connected with. All but the set refers to
/// what the method keeps.
struct WideEyePlan {
  TechniqueSet set;
  uint64_t key = 0;  ///< of the iteration's random numbers beside the sampler's
  float roulette_threshold = 0;
  /// With LightPassPlan::keep_connection_vertices; if in batches, of the same WideScene, since its
  /// vertices name the glossy materials of that.
  const LightPass* lights = nullptr;
  const SubpathSharing* sharing = nullptr;
  const EmissionGuide* guide = nullptr;  ///< or null
  const VertexGrid* photons = nullptr;   ///< if the set merges
  const MergeMask* mask = nullptr;       ///< if it does so in part
  /// Null if each vertex is connected with all those of a light sub-path of its tile.
  const DrawnVertices* drawn = nullptr;

  bool merges_in(uint64_t pixel) const {
    return set.partly_merged ? mask->merges_in(pixel) : set.merges;
  }
};

/// Traces eye sub-paths of bidirectional path tracing without media, in the same way as
/// BidirectionalIntegrator traces one: the same random numbers give the same sub-paths and, to
/// rounding, the same contributions. Connections of diffuse and glossy vertices are weighed in
/// loops over pairs, others one by one; their shadow rays are tested together.
class WideEye final : public WideWalk, private WideSubpathStages {
 public:
  /// What is referred to must outlive this; the plan may change between batches, but for its
  /// groups of pixels.
  WideEye(const WideScene& scene, const PathLimits& limits, const WideEyePlan& plan)
      : WideSubpathStages(scene, limits, Transport::radiance),
        plan_(plan),
        starts_(scene.scene),
        pairs_(2 + scene.glossy.size()),
        evaluate_ends_(scene.glossy) {
    if (plan.set.pixel_group > 1) groups_.emplace(scene, limits.strict_normals, plan.set);
  }

  WidePaths& paths() override { return paths_; }
  void enter(std::span<const uint64_t> pixels) override;
  void trace(int n, const BatchSampler& sampler, WideSamples& samples,
             RenderCounters& counters) override;

 private:
  /// What an eye vertex is connected with.
  struct LightSubpath {
    size_t index;
    uint32_t first;  ///< among all vertices
    int count;       ///< vertices
    int length;      ///< the same with those that cannot be connected
  };

  /// Where contributions go: to a pixel, or to the second vertex that its group shares, with
  /// WideShadowRays::varying.
  struct Sums {
    WideSamples& samples;
    WideEyeGroups* groups;
    bool shares(int id) const { return groups && groups->shares(id); }
    void add(int id, const Spectrum& s, float varying) {
      if (shares(id))
        groups->add(id, s, varying);
      else
        samples.add(id, s);
    }
  };

  void begin(int n);
  /// Once textures are looked up, before there are ends.
  void share_vertices(int n, int depth);
  int end_outside(int n, Sums& sums, RenderCounters& counters);
  /// What `connect(subpath)` finds at the end of a sub-path.
  template <class F>
  void add_found(int i, Sums& sums, const F& connect);
  void add_emission(int depth, Sums& sums, RenderCounters& counters);
  /// Makes Partials of the points; at the first, where light tracing competes, of their own.
  void arrive_at_points(int n, int depth);
  void sample_lights(int n, int depth, Sums& sums, RenderCounters& counters);

  // wide_connections.cpp
  void connect(int n, int depth, Sums& sums, RenderCounters& counters);
  LightSubpath light_subpath(int i, int depth) const;
  /// Of a point in lanes, with these light vertices.
  void find_pairs(int i, const LightSubpath& light, int depth, Sums& sums,
                  RenderCounters& counters);
  /// Makes shadow rays of the pairs in a list.
  void weigh(size_t list, int depth);
  /// The same of pairs whose light vertices are glossy.
  void weigh_glossy_lights(int count, const WidePairs& pairs, int depth);
  /// Connects the points with vertices drawn for each of them.
  void connect_drawn(int n, int depth, Sums& sums, RenderCounters& counters);
  /// One point with the light vertex `index`, the k-th that is drawn for it.
  void connect_drawn(int i, int k, uint32_t index, int depth, Sums& sums, RenderCounters& counters);
  bool connects_at(int i);
  /// One vertex with one light vertex; at least one of them is special. `drawn` is as in
  /// weigh_ends().
  void connect_one_by_one(int i, const PathVertex& light, int drawn, int depth, Sums& sums,
                          RenderCounters& counters);
  void flush_pairs(size_t list, int depth, Sums& sums, RenderCounters& counters);
  void flush_single(Sums& sums, RenderCounters& counters);
  /// WideShadowRays::varying of one connection.
  float varying_part(const PathVertex& light, const PathVertex& eye,
                     const EndsConnection& ends) const;
  /// test_shadows() of rays that have WideShadowRays::varying.
  Tested test_connections(int n, WideShadowRays& rays, Sums& sums);
  const PathVertex& eye_vertex(int i, int depth);
  const PathVertex& light_vertex(const LightSubpath& light, int number);

  // wide_merges.cpp
  void merge(int n, int depth, Sums& sums, RenderCounters& counters);
  bool merges_at(int i);
  /// Lists the photons that may be near a point; returns for how many each of them stands.
  size_t list_photons(int i, int& count);
  /// Merges those of the first `count` listed photons that are near their points.
  void merge_listed(int count, int depth, RenderCounters& counters);
  /// With a special point.
  void merge_one(int i, const LightVertex& photon, int depth, RenderCounters& counters);
  /// With those of the points listed that are diffuse, or glossy.
  void merge_near(bool glossy, int depth, RenderCounters& counters);
  void add_merged(int i, const Spectrum& s) {
    merged_.set(i, merged_.x[i] + s.r, merged_.y[i] + s.g, merged_.z[i] + s.b);
  }

  ConnectionRoulette roulette(int id) const {
    return {plan_.roulette_threshold, keys_[size_t(id)]};
  }
  ConnectionContext<BalanceWeights> context(int id, const ConnectionRoulette& roulette,
                                            RenderCounters& counters) const {
    return {wide_.scene, starts_,  weights_[merging_[size_t(id)]],
            roulette,    counters, limits_.strict_normals};
  }
  float scale() const { return plan_.drawn ? plan_.drawn->scale() : 1.0f; }
  float camera_scale() const { return plan_.set.connection_share / plan_.set.light_paths; }
  /// `eye_paths` is that of pairs.
  WideConnections connections(int depth, float eye_paths = 1) const {
    return {paths_,
            subpaths_,
            points_,
            ends_,
            plan_.set.connection_share,
            camera_scale(),
            plan_.roulette_threshold,
            ConnectionRoulette::event(0, depth),
            depth == 1,
            scale(),
            eye_paths};
  }
  /// As the code for one sub-path has it, on its way to the next vertex.
  Subpath subpath(int i) const;

  const WideEyePlan& plan_;
  LightStarts starts_;
  /// In pixels that do not merge, and in those that do.
  std::array<BalanceWeights, 2> weights_{BalanceWeights({}), BalanceWeights({})};
  std::vector<uint64_t> keys_;    ///< of ConnectionRoulette, by id
  std::vector<uint64_t> random_;  ///< state of numbers beside the sampler's, by id
  BatchTriples camera_origin_{};  ///< where the camera's rays begin, by id
  std::vector<uint8_t> merging_;  ///< whether the pixel merges, by id
  /// If the set merges:
  VertexGrid::NeighborhoodBatch around_{};  ///< of the points
  BatchArray<float> kernel_{};              ///< WideMerges::kernel
  BatchTriples merged_{};                   ///< what has been merged at the points
  /// Entries of the grid, then indices of photons, with the numbers of their points. Listed are so
  /// many at a time, and those of one more point.
  static constexpr int kPhotonsAtOnce = kMostMergedPhotons;
  std::vector<uint32_t> photon_entries_;
  std::vector<int32_t> photon_points_;
  struct NearPhotons {
    WidePhotons photons{};
    int count = 0;
  };
  std::array<NearPhotons, 2> near_;  ///< photons of diffuse points, and of glossy ones
  BatchTriples near_sums_{};
  BatchArray<int32_t> near_merged_{};
  std::vector<uint32_t> own_light_;   ///< SubpathSharing::subpath(), by id
  std::vector<PathVertex> unpacked_;  ///< light vertices that were needed as such
  /// Where the vertices of a light sub-path begin among these, of the last one that had this place:
  /// those of a tile have numbers in succession, unless none is shared.
  struct UnpackedSubpath {
    size_t subpath = ~size_t{0};
    int first = 0;
  };
  std::array<UnpackedSubpath, 4 * kBatch> unpacked_subpaths_;
  /// Those of eye vertices of one material with diffuse light vertices: the first list has all
  /// diffuse ones, others have one glossy material each (WideShape::pair_list()). The last list has
  /// the pairs with glossy light vertices.
  struct PairList {
    WidePairs pairs{};
    int count = 0;
  };
  std::vector<PairList> pairs_;
  EvaluateEnds evaluate_ends_;
  EndBsdfs eye_bsdfs_{};
  /// The light vertices of the last list, by pair.
  struct GlossyLightVertices {
    EndBsdfs bsdfs;
    WidePaths paths;    ///< with directions of arrival alone
    WidePoints points;  ///< with the lit normal and the reflectance alone
    BatchTriples throughput;
  };
  GlossyLightVertices glossy_lights_{};
  std::optional<WideEyeGroups> groups_;  ///< of pixels, if there are any
  BatchArray<int32_t> tested_ids_{};     ///< pixels of the connections that are tested
  WideShadowRays single_{};              ///< of connections that were weighed one by one
  int single_count_ = 0;
  uint32_t first_light_ = 0;  ///< the light vertex that pairs count from
};

}  // namespace duet
