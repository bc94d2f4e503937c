// Rays that pass what they meet: shadow rays through media and surfaces which let light straight
// through, and camera rays behind lights that are not to be seen.
#pragma once

#include "media/spectral_weights.h"
#include "scene/scene.h"
#include "transport/counters.h"

namespace duet {

/// A ray of unit direction that ends just before `target`.
inline Ray ray_to(const Point3f& origin, const Point3f& target) {
  const Vector3f d = target - origin;
  const float l = length(d);
  return {origin, d / l, l * 0x1.fffep-1f};
}

/// The rest of a ray beyond the surface that it has hit, of the same direction.
inline Ray beyond_hit(const Scene& scene, const Ray& ray, const Hit& hit) {
  Ray rest = spawn_ray(scene.surface(ray, hit), ray.direction);
  rest.tmax = ray.tmax - hit.t;
  return rest;
}

/// The camera's ray continued behind all emitting surfaces that it meets first: what
/// `hide_emitters` means in Mitsuba 3. The environment is hidden by whoever traces the ray.
inline Ray behind_emitters(const Scene& scene, Ray ray, RenderCounters& counters) {
  for (;;) {
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(ray, hit) || scene.shapes[hit.shape].light == kNone) return ray;
    ray = beyond_hit(scene, ray, hit);
  }
}

/// A shadow ray and the medium that it starts in.
struct ShadowRay {
  Ray ray;               ///< of unit direction
  const Medium* medium;  ///< or null
};

/// Multiplies `w` by what gets through from the origin of a ray to its tmax, and by the densities
/// of a sub-path that would have taken the same way; false if nothing does. `nominal`, if not null,
/// is multiplied by the nominal transmittance.
inline bool shadow_transmittance(const Scene& scene, const ShadowRay& shadow, RandomStream& random,
                                 SpectralWeights& w, RenderCounters& counters,
                                 float* nominal = nullptr) {
  auto [ray, medium] = shadow;
  for (;;) {
    ++counters.shadow_rays;
    Hit hit;
    bool found = false;
    if (!scene.has_passable_surfaces) {
      if (scene.accel->occluded(ray)) return false;
    } else {
      found = scene.accel->closest_hit(ray, hit);
      if (found && !scene.materials[scene.shapes[hit.shape].material]->passes_straight())
        return false;
    }
    const float left = found ? ray.tmax - hit.t : 0.0f;
    if (medium) {
      Ray segment = ray;
      if (found) segment.tmax = hit.t;
      const RandomStream before = random;
      medium->transmit(segment, random, w);
      counters.medium_steps += 1 + random.drawn_since(before);
      if (w.value.is_black()) return false;
      if (nominal) *nominal *= medium->nominal_transmittance(segment);
    }
    if (!found) return true;
    const Surface s = scene.surface(ray, hit);
    const Bsdf bsdf = scene.materials[s.shape->material]->bind(s, -ray.direction);
    w.value *= bsdf.straight_through();
    if (w.value.is_black()) return false;
    if (s.shape->separates_media()) medium = scene.medium_beyond(s, ray.direction);
    ray = spawn_ray(s, ray.direction);
    ray.tmax = left;
  }
}

}  // namespace duet
