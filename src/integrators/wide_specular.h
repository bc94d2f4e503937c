// What batches of paths do at points of materials with delta lobes alone.
#pragma once

#include "integrators/wide_glossy.h"
#include "materials/plain_diffuse.h"

namespace duet {

/// Samples directions: see BranchFreeSample. Densities are negative. Reverse densities are
/// specular_jacobian().
void sample_specular(int n, const SpecularSurface& surface, const WideVertices& vertices,
                     WideGlossy& out);

}  // namespace duet
