// What the paths of a batch are at: every stage reads and writes arrays.
#pragma once

#include "cameras/camera.h"
#include "geometry/ray_batch.h"
#include "math/batch_sampler.h"
#include "math/spectrum.h"

namespace duet {

[[gnu::always_inline]] inline Spectrum color_at(const BatchTriples& t, int i) {
  return {t.x[i], t.y[i], t.z[i]};
}

/// The paths that are still growing, without gaps.
struct WidePaths {
  RayBatch ray;  ///< to the next vertex
  BatchTriples throughput;
  BatchArray<float> bsdf_pdf;  ///< of the ray; negative if light samples do not compete with it
  BatchTriples from;           ///< the previous vertex
  BatchArray<float> eta;       ///< relative index of refraction along the path
  BatchArray<int32_t> id;      ///< its pixel, which has its sums
  BatchKeys keys;

  /// Begins path `n` with the camera's ray through pixel `pixel`, whose keys these are.
  void start(int n, int pixel, const CameraRay& from_camera, const BatchKeys& of_pixels) {
    ray.origin.set(n, from_camera.origin);
    ray.direction.set(n, from_camera.direction);
    ray.tmax[n] = from_camera.tmax;
    from.set(n, from_camera.origin);
    throughput.set(n, 1, 1, 1);
    bsdf_pdf[n] = -1;
    eta[n] = 1;
    id[n] = pixel;
    keys.high[n] = of_pixels.high[pixel], keys.low[n] = of_pixels.low[pixel];
  }
};

/// Corners of the triangles that were hit; all normals are zero where the mesh has none.
struct WideTriangles {
  BatchTriples p0, p1, p2, n0, n1, n2;
  BatchArray<float> sign;  ///< −1 if the normals are to be turned, else 1
};

/// Surface points; the diffuse reflectance is that of plainly diffuse surfaces, zero elsewhere.
struct WidePoints {
  BatchTriples position, ng, ns;  ///< see Surface
  BatchArray<float> offset;
  BatchTriples reflectance;
  BatchArray<int32_t> two_sided;
};

/// Random numbers of one vertex.
struct WideNumbers {
  BatchArray<float> light_x, light_y, light_choice;
  BatchArray<float> x, y;
  /// Of a BSDF that chooses, what it chooses by and roulette after it; of others roulette is first.
  BatchArray<float> first, second;
};

/// Light samples, and what surfaces make of them.
struct WideLightSamples {
  BatchTriples wi, target;  ///< see LightSample
  BatchTriples weight;
  BatchArray<float> pdf;          ///< with the probability of the choice; negative without a sample
  BatchArray<float> probability;  ///< of the choice
  BatchArray<int32_t> finite, delta;
  BatchArray<float> emission;  ///< LightSample::emission, but of flat lights
  BatchTriples value;          ///< of the BSDF
  BatchArray<float> bsdf_pdf;
};

/// What light samples contribute unless something is in their way.
struct WideShadowRays {
  RayBatch ray;
  BatchTriples contribution;
  BatchArray<int32_t> id;
  /// What is not 0 need not be tested: something is in the way, or there is nothing to contribute.
  BatchArray<int32_t> blocked;
  static constexpr int32_t kNothing = 2;  ///< in `blocked` of connections: even without roulette
  /// Of connections of eye vertices, how much of the weight's denominator varies with the pixels
  /// of a group (WideEyeGroups). Stays where it is when rays are moved to the front.
  BatchArray<float> varying;
};

/// How the paths go on.
struct WideScattering {
  BatchTriples wi, weight;
  BatchArray<float> pdf;  ///< negative for a delta lobe
  BatchArray<float> eta;
  BatchArray<float> roulette;  ///< its number
  BatchArray<int32_t> alive;
  BatchArray<int32_t> null;  ///< passed straight through
};

}  // namespace duet
