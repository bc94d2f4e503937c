// Groups of pixels of bidirectional path tracing.
#pragma once

#include "integrators/wide_pixel_groups.h"
#include "integrators/wide_subpaths.h"

namespace duet {

/// Groups whose paths are weighed against light sub-paths. How much of what an eye sub-path finds
/// beyond its second vertex counts for a pixel depends on the first vertex of that: on what is
/// called `outset` here, the relative densities of the techniques that have the second vertex, or
/// that and the first, at the end of the light sub-path: 1 / (N p_i) and what lies before, for N
/// paths of the group with density p_i. The rest is the same for all pixels, so contributions are
/// kept with their weight for their own pixel and the share of its denominator that varies.
/// Source: docs/pixel_groups.md.
class WideEyeGroups final : public WidePixelGroups {
 public:
  WideEyeGroups(const WideScene& scene, bool strict_normals, const TechniqueSet& set)
      : WidePixelGroups(scene, strict_normals, set.pixel_group, false),
        connects_(set.subpath_connections()) {}

  void start(int count, uint64_t key);
  void note_first(int n, const WidePaths& paths, const Vertices& at, const WideSubpaths& subpaths);
  /// Once second vertices are noted and `ends` is made of them: sums count all paths of a group
  /// from there on, and `vm` has the part of `vc` that varies with the outset.
  void count_paths(int n, const WidePaths& paths, WideSubpaths& subpaths, WideEnds& ends);
  /// Keeps what a path finds beyond its second vertex, which is shared: weighted for its own
  /// pixel, and how much of the weight's denominator varies.
  void add(int id, const Spectrum& s, float varying);
  /// Adds to each pixel what the second vertices of its group scatter towards its first.
  void add_to(WideSamples& samples, RenderCounters& counters);

 private:
  struct Found {
    Spectrum value;
    float varying;
    int next;  ///< number of the one before it from the same vertex, or −1
  };
  /// Of the pairs of one second vertex: the outset over that of the path that has found it, and
  /// sums of what counts for each.
  struct Weighed {
    BatchArray<float> ratio, r, g, b;
  };
  /// What these pairs have in common.
  struct Target {
    Point3f position;
    float outset;  ///< of the path that has found it
    float connects;
  };
  struct Firsts {
    const First& at;
    const BatchArray<float>& vcm;
  };
  static void begin_weighing(const Shared& s, const Target& target, const Pairs& pairs,
                             const Firsts& firsts, Weighed& out);
  static void add_weighed(int n, const Found& found, Weighed& sums);
  static void end_weighing(const Shared& s, float scale, const Pairs& pairs, const Weighed& weighed,
                           BatchTriples& sums);

  const float connects_;            ///< TechniqueSet::subpath_connections()
  BatchArray<float> first_vcm_{};   ///< Partials::vcm at first vertices, by places
  BatchArray<float> own_outset_{};  ///< of the path that has found a second vertex, by places
  std::vector<Found> found_;
  BatchArray<int32_t> last_found_{};  ///< by places; −1 if nothing
  Weighed weighed_{};
};

}  // namespace duet
