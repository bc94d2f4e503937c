// What batches of paths do at points of rough conductors.
#pragma once

#include "integrators/wide_glossy.h"
#include "materials/plain_diffuse.h"

namespace duet {

/// Values for the light samples, at `n` points of one conductor; the reflectance is the specular
/// one.
void evaluate_glossy(int n, const RoughConductorSurface& surface, const WideVertices& vertices,
                     const BatchTriples& light, WideGlossy& out);
/// Directions from there.
void sample_glossy(int n, const RoughConductorSurface& surface, const WideVertices& vertices,
                   WideGlossy& out);

}  // namespace duet
