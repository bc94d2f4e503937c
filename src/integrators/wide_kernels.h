// The stages of a batch of paths that are loops over numbers: the same formulas, in the same order,
// as those of one path at a time (PathIntegrator, PlainDiffuse, make_mesh_surface()), so
// that the results are the same bit for bit. All work on the first `n` of a batch.
#pragma once

#include "integrators/wide_state.h"

namespace duet {

/// What make_mesh_surface() makes of hits, but for texture coordinates and tangents.
void make_points(int n, const WideTriangles& triangles, const HitBatch& hits, WidePoints& points);
/// The same with shading normals.
void make_smooth_points(int n, const WideTriangles& triangles, const HitBatch& hits,
                        WidePoints& points);
/// What plainly diffuse surfaces make of light samples.
void evaluate_diffuse(int n, const WidePaths& paths, const WidePoints& points,
                      WideLightSamples& samples);
/// Directions from plainly diffuse surfaces.
void sample_diffuse(int n, const WidePaths& paths, const WidePoints& points,
                    const WideNumbers& numbers, WideScattering& out);
/// Contributions of light samples, weighted against BSDF samples, and their shadow rays.
void weigh_light_samples(int n, const WidePaths& paths, const WidePoints& points,
                         const WideLightSamples& samples, WideShadowRays& out);
/// The next rays, with or without roulette; `scattering.alive` says which there are.
void go_on(int n, bool roulette, const WidePoints& points, WideScattering& scattering,
           WidePaths& paths);

}  // namespace duet
