// A look at a scene with all techniques at once, on a few pixels: what each contribution to the
// image tells about the methods that could have made it.
#pragma once

#include <vector>

#include "scene/description_integrators.h"
#include "transport/counters.h"
#include "transport/family_weights.h"

namespace duet {

/// Which kind of technique made a contribution.
enum class Technique : uint8_t {
  unidirectional,
  light_image,
  connection,
  first_merge,  ///< at the first vertex of the eye sub-path where FamilyShares::first_merge is
  later_merge
};

/// A weighted contribution, f / Σ n_i p_i of its path.
struct PilotSample {
  float value, square;  ///< means over the colours
  FamilyShares shares;  ///< in the density of all techniques
  Technique technique;
  /// Of a merge: the share of it that is blur, less that of photons that are missing
  /// (merge_blur.h), with the radius of the first iteration.
  float blur;
  uint16_t cell;        ///< where in the image: row by row of the pilot's pixels
  bool shared = false;  ///< found beyond a second vertex that a group of pixels would share
};

struct PricingPlan : PathLimits {
  Point2i film;              ///< size of the whole image
  int pixels_per_side = 32;  ///< the pilot looks at this number squared
  int threads = 1;
  uint64_t seed = 0;  ///< pilots of different seeds are independent
};

/// What a pilot has seen. Two eye sub-paths for each of its pixels, and as many light sub-paths.
struct PricingRecord {
  /// Light sub-paths per pixel in the weights.
  static constexpr double kLightPaths = 1;
  /// Pairs of vertices that are near enough to be merged are looked at with this probability.
  static constexpr double kMergeShare = 0.25;

  std::vector<PilotSample> eye;  ///< sub-path after sub-path
  std::vector<uint32_t> ends;    ///< sub-path i has [ends[i − 1], ends[i])
  std::vector<PilotSample> light;
  int side = 0;  ///< of the grid of pixels
  /// Light seen without any scattering, by cell: it is the same for all methods.
  std::vector<double> seen;

  RenderCounters eye_counters;         ///< eye sub-paths and light samples
  RenderCounters connection_counters;  ///< connections
  RenderCounters merge_counters;       ///< of the pairs that were looked at
  /// Of both, what eye sub-paths do until they first scatter by a smooth lobe.
  RenderCounters first_counters;
  RenderCounters light_counters;  ///< light sub-paths and what the camera sees of them
  double light_vertices = 0;      ///< that can be connected
  bool batches = false;  ///< whether bdpt and vcm trace eye sub-paths in batches (wide_eye.h)

  size_t subpaths() const { return ends.size(); }
};

/// The result depends on the scene and the plan, but not on its number of threads. The scene has a
/// light, and `max_depth` is not below 2.
PricingRecord run_pricing_pilot(const Scene& scene, const PricingPlan& plan);

}  // namespace duet
