// What batches of paths do at points of rough dielectrics.
#pragma once

#include "integrators/wide_glossy.h"
#include "materials/plain_diffuse.h"

namespace duet {

/// Values for the directions `out.towards`, on either side, at `n` points of one dielectric.
void evaluate_glossy(int n, const RoughDielectricSurface& surface, const WideVertices& vertices,
                     WideGlossy& out);
/// Directions from there, with WideGlossy::eta.
void sample_glossy(int n, const RoughDielectricSurface& surface, const WideVertices& vertices,
                   WideGlossy& out);
/// The reverse densities for `out.towards`.
void reverse_glossy(int n, const RoughDielectricSurface& surface, const WideVertices& vertices,
                    WideGlossy& out);

}  // namespace duet
