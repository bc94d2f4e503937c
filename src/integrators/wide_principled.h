// What batches of paths do at points of Burley's principled material.
#pragma once

#include "integrators/wide_glossy.h"
#include "materials/plain_diffuse.h"

namespace duet {

/// Values for the directions `out.towards`, at `n` points of one material; the reflectance is the
/// base colour.
void evaluate_glossy(int n, const PrincipledSurface& surface, const WideVertices& vertices,
                     WideGlossy& out);
/// Directions from there.
void sample_glossy(int n, const PrincipledSurface& surface, const WideVertices& vertices,
                   WideGlossy& out);
/// The reverse densities for `out.towards`.
void reverse_glossy(int n, const PrincipledSurface& surface, const WideVertices& vertices,
                    WideGlossy& out);

}  // namespace duet
