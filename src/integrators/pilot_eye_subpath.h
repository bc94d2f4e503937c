// The eye sub-paths of the pricing pilot: all techniques at every vertex, with what each of their
// contributions tells about the others.
#pragma once

#include <memory>

#include "integrators/pilot_light_subpaths.h"
#include "integrators/pricing_pilot.h"
#include "transport/light_starts.h"
#include "transport/subpath.h"
#include "transport/vertex_grid.h"

namespace duet {

/// What the sub-paths of a pilot have in common.
struct PilotSetup {
  const Scene& scene;
  PricingPlan plan;
  int max_depth = 0;  ///< segments of a path
  SubpathOptions options{};
  TechniqueSet set{};
  uint64_t eye_seed = 0;
  float threshold = 0;     ///< of the roulette for connections
  float first_radius = 0;  ///< of merging, in the first iteration of the render
  float query_radius = 0;  ///< within which the pilot merges
  float shift_scale = 1;   ///< of the distances to photons: PhotonShift::scale
  PilotLightSubpaths light{};
  std::unique_ptr<const EmissionGuide> guide{};  ///< of the starts of light sub-paths, or null
  VertexGrid grid{};                             ///< of the photons among their vertices
};

/// Adds a weighted contribution to the image, unless it is nothing.
void add_contribution(std::vector<PilotSample>& to, const Spectrum& v, const FamilyShares& shares,
                      Technique technique, uint16_t cell, float blur = 0);

/// Traces the eye sub-path of this number, and appends to `out` what it has found. Light that is
/// seen without any scattering, and is the same in all sub-paths through the pixel, is added to
/// `seen` instead. `Vertex` is PathVertex or, where there are media, MediaVertex.
template <class Vertex>
void trace_pilot_eye_subpath(const PilotSetup& pilot, size_t index, PricingRecord& out,
                             double& seen);

}  // namespace duet
