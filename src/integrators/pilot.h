// What has to be known about a scene before the first iteration, from a few sub-paths that are not
// part of the image.
#pragma once

#include "image/film.h"
#include "transport/light_pass.h"

namespace duet {

struct Pilot {
  double vertices_per_subpath = 0;  ///< those that can be connected
  double brightness = 0;  ///< mean of the image, as far as light sub-paths reach it directly
  double footprint = 0;   ///< side of a pixel where it meets surfaces, in world units

  /// Radius of the first iteration's merging unless the user says otherwise.
  double first_radius() const { return 1.5 * footprint; }
  /// Contributions below which connections are left to chance: too little to be seen in the noise
  /// of a sample.
  float roulette_threshold() const { return float(0.1 * brightness); }
};

/// The side of a pixel where it meets surfaces, in world units: the median over the image.
double pixel_footprint(const Scene& scene, Point2i film);

/// `plan` is that of a whole iteration. The result does not depend on its seed.
Pilot run_pilot(const Scene& scene, Point2i film, LightPassPlan plan);

}  // namespace duet
