// Noise in space, and sums of its octaves.
#pragma once

#include "math/vector.h"

namespace duet {

/// Smooth noise in [−1, 1] with a mean of zero; zero at all points of the integer lattice, with the
/// period 256 in each direction.
/// Source: Perlin, "Improving Noise", SIGGRAPH 2002, with the permutation of the paper's reference
/// implementation.
float perlin_noise(const Point3f& p);

/// Σ roughness^k · noise(1.99^k p) over `octaves` octaves: no frequency is left out.
float fractal_noise(const Point3f& p, float roughness, int octaves);

/// The same with absolute values, and 0.2 · roughness^octaves added, the mean of the octave after
/// the last: what pbrt adds for all frequencies that it leaves out.
float turbulence(const Point3f& p, float roughness, int octaves);

}  // namespace duet
