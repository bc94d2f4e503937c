// The stages of a batch of paths that are loops over numbers: the same formulas, in the same order,
// as those of one path at a time (PathIntegrator, PlainDiffuse, make_mesh_surface()), so
// that the results are the same bit for bit. All work on the first `n` of a batch.
#pragma once

#include <optional>

#include "integrators/wide_state.h"
#include "transport/roulette.h"

namespace duet {

/// The place where a ray starts or ends that leaves a surface under a cosine with its normal: see
/// offset_position().
[[gnu::always_inline]] inline Point3f moved_off(const Point3f& p, const Vector3f& ng, float offset,
                                                float cosine) {
  return p + ng * (cosine < 0 ? -offset : offset);
}

/// The shadow ray of a light sample: spawn_ray_to() or spawn_ray().
[[gnu::always_inline]] inline void set_shadow_ray(int i, const WidePoints& points,
                                                  const WideLightSamples& samples, RayBatch& out) {
  const Point3f position = points.position.point(i), target = samples.target.point(i);
  const Vector3f ng = points.ng.vector(i), wi = samples.wi.vector(i), away = target - position;
  const bool finite = samples.finite[i] != 0;
  const Point3f origin =
      moved_off(position, ng, points.offset[i], finite ? dot(ng, away) : dot(ng, wi));
  const Vector3f to_target = target - origin;
  out.origin.set(i, origin);
  out.direction.set(i, finite ? to_target.x : wi.x, finite ? to_target.y : wi.y,
                    finite ? to_target.z : wi.z);
  out.tmax[i] = finite ? 0x1.fffep-1f : INFINITY;
}

/// Of points of triangles.
struct WideBarycentrics {
  const BatchArray<float>&b1, &b2;
};

/// What make_mesh_surface() makes of them, but for texture coordinates and tangents.
void make_points(int n, const WideTriangles& triangles, const WideBarycentrics& at,
                 WidePoints& points);
/// The same with shading normals.
void make_smooth_points(int n, const WideTriangles& triangles, const WideBarycentrics& at,
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
/// The next rays, with roulette if there is one; `scattering.alive` says which there are.
void go_on(int n, const std::optional<Roulette>& roulette, const WidePoints& points,
           WideScattering& scattering, WidePaths& paths);

}  // namespace duet
