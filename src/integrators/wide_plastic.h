// What batches of paths do at points of rough plastics.
#pragma once

#include "integrators/wide_state.h"
#include "materials/plain_diffuse.h"

namespace duet {

/// What the points of a batch have: see WideTracer.
struct WideVertices {
  const WidePaths& paths;
  const WidePoints& points;  ///< the reflectance is that of the base
  const WideNumbers& numbers;
};

/// Some of the points, and what is made of them, without gaps.
struct WidePlastics {
  BatchArray<int32_t> at;  ///< numbers of the points
  BatchTriples value;      ///< of the BSDF, for the light samples
  BatchArray<float> value_pdf;
  BatchTriples wi, weight;  ///< see WideScattering
  BatchArray<float> pdf, roulette;
  BatchArray<int32_t> alive;
};

/// Values for the light samples, at `n` points of one plastic.
void evaluate_plastic(int n, const RoughPlasticSurface& surface, const WideVertices& vertices,
                      const BatchTriples& light, WidePlastics& out);
/// Directions from there.
void sample_plastic(int n, const RoughPlasticSurface& surface, const WideVertices& vertices,
                    WidePlastics& out);

}  // namespace duet
