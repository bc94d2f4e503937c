// Next event estimation, as all methods do it: the choice of a light and of a point on it, and the
// density with which that choice makes a ray that has found a light by itself.
#pragma once

#include "lights/area.h"
#include "math/sampler.h"
#include "scene/scene.h"

namespace duet {

/// A light chosen and seen from a point, with the probability of its choice; no sample if it sends
/// nothing there.
struct ChosenLight {
  std::optional<LightSample> sample;
  float probability;
  uint32_t light;  ///< its index
};

/// Whether there is more than one light to choose from.
inline bool has_light_choice(const Scene& scene) {
  return scene.lights.size() > 1;
}

/// `u` picks the point of the light and, where there is a choice, `choice` the light. The scene
/// must have one.
[[gnu::always_inline]] inline ChosenLight choose_light(const Scene& scene, const Point3f& from,
                                                       const Point2f& u, float choice) {
  const LightPicker::Pick pick =
      has_light_choice(scene) ? scene.direct_picker.pick(choice, u, from) : LightPicker::Pick{0, 1};
  const Light& light = *scene.lights[pick.light];
  // The common kind is called directly, so that the compiler can look into it.
  return {light.kind() == LightKind::area
              ? static_cast<const AreaLight&>(light).sample_direct(from, u)
              : light.sample_direct(from, u),
          pick.probability, pick.light};
}

/// The same with two or three dimensions of the sampler.
[[gnu::always_inline]] inline ChosenLight choose_light(const Scene& scene, const Point3f& from,
                                                       Sampler& sampler) {
  const Point2f u = sampler.next_2d();
  return choose_light(scene, from, u, has_light_choice(scene) ? sampler.next_1d() : 0.0f);
}

/// Density per solid angle at `from` with which choose_light() makes the direction `w`, which has
/// met the surface `s` of a light at squared distance `d2`.
inline float choice_density(const Scene& scene, const SurfaceLight& light, const Point3f& from,
                            const Surface& s, const Vector3f& w, float d2) {
  return light.pdf_direct(from, s, w, d2).value *
         scene.direct_picker.probability(s.shape->light, from);
}

/// The same for a direction that leaves the scene, which must have an environment.
inline float choice_density(const Scene& scene, const Point3f& from, const Vector3f& w) {
  return scene.environment->pdf_direct(from, w).value *
         scene.direct_picker.probability(scene.environment_index, from);
}

}  // namespace duet
