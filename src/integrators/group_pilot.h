// What groups of pixels would gain, tried on a few tiles.
#pragma once

#include <array>

#include "integrators/pricing_pilot.h"

namespace duet {

/// Members of the groups that `auto` has. Of larger ones one sees the tiles, whose pixels have
/// their noise in common then (docs/pixel_groups.md).
inline constexpr std::array kAutoPixelGroups{16, 32};

/// Groups of pixels over single ones, with the same paths.
struct GroupGain {
  int members = 1;
  double variance = 1;     ///< ratio of the variances of a sample of a pixel
  double shadow_rays = 0;  ///< more of them per path
};
using GroupGains = std::array<GroupGain, kAutoPixelGroups.size()>;

/// Whether the scene's paths can be traced in groups, and have second vertices to share.
bool suits_pixel_groups(const Scene& scene, const PathLimits& limits);

/// Traces paths of tiles that cover the image evenly. The result depends on the scene and the plan,
/// but not on its number of threads.
GroupGains measure_pixel_groups(const Scene& scene, const PricingPlan& plan);

}  // namespace duet
