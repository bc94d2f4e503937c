// Shadow rays that pass media and surfaces which let light straight through.
#pragma once

#include "integrators/integrator.h"
#include "media/spectral_weights.h"

namespace duet {

/// Multiplies `w` by what gets through from the origin of `ray` to ray.tmax, and by the densities
/// of a walk that would have taken the same way; false if nothing does. The direction has unit
/// length; `medium` (or null) is what the ray starts in.
inline bool walk_shadow(const Scene& scene, Ray ray, const Medium* medium, RandomStream& random,
                        SpectralWeights& w, RenderCounters& counters) {
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
      medium->transmit(segment, random, w);
      if (w.value.is_black()) return false;
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
