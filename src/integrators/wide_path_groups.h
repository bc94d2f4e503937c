// Groups of pixels of path tracing.
#pragma once

#include "integrators/wide_pixel_groups.h"

namespace duet {

/// What second vertices scatter is one sum for each: weights of `path` do not depend on where a
/// path has come from.
class WidePathGroups final : public WidePixelGroups {
 public:
  WidePathGroups(const WideScene& scene, bool strict_normals, int members)
      : WidePixelGroups(scene, strict_normals, members, true) {}

  void start(int count, uint64_t key);
  void note_second(int n, WidePaths& paths, const Vertices& at);
  /// Says that what the second vertices scatter of these light samples is to be added next, or of
  /// light from the next directions: how much of it is scattered by bases.
  void set_shares(const WideVertices& at, const WideLightSamples& samples);
  void set_shares(const WideVertices& at, const WideScattering& next);
  /// Adds what a path finds beyond its second vertex, which is shared. What only the pixel itself
  /// can use of it goes to `own`.
  void add(int id, const Spectrum& s, WideSamples& own) {
    const int k = place(id);
    const Spectrum shared = s * color_at(share_, k);
    scattered_.add(k, shared);
    own.add(id, (s - shared) * color_at(second_.tint, k));
  }
  /// Adds to each pixel what the second vertices of its group scatter towards its first.
  void add_to(WideSamples& samples, RenderCounters& counters);

 private:
  /// `value(i)` is the BSDF at point i for its direction, 0 for delta lobes.
  template <class F>
  void set_base_shares(const WideVertices& at, const BatchTriples& towards, F&& value);
  static void add_scattered(const Shared& s, const Pairs& pairs, const Spectrum& scattered,
                            BatchTriples& sums);

  WideSamples scattered_{};  ///< by second vertices, times Second::scale; by places
  BatchTriples share_{};     ///< of what is added that the base scatters; 1 of diffuse surfaces
};

}  // namespace duet
