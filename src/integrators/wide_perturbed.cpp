// What batches do at points below bump and normal maps: see Tilt.
#include "integrators/wide_stages.h"
#include "materials/wrappers.h"

namespace duet {

void WideStages::perturb_normals() {
  perturbed_.clear();
  for (size_t k = 0; k < special_.size(); ++k) {
    const int i = special_[k];
    const WideShape& shape = wide_.shapes[hits_.shape[i]];
    if (!shape.perturbed) continue;
    const Surface& s = surfaces_[k];
    if (shape.textured) set_reflectance(i, (*shape.textured)(s));
    const PerturbedSurface& surface = *wide_.maps[hits_.shape[i]];
    const Vector3f wo = s.shading.to_local(-paths_.ray.direction.vector(i));
    const Tilt tilt = surface.map.tilt(s, surface.two_sided && wo.z < 0 ? -1.0f : 1.0f);
    points_.ns.set(i, s.shading.to_world(tilt.normal(tilt.turned_for(wo))));
    perturbed_.push_back({i, k, tilt});
  }
}

void WideStages::shade_perturbed_points() {
  if (wide_.maps.empty()) return;
  for (const PerturbedPoint& p : perturbed_) {
    const int i = p.point;
    const Frame& shading = surfaces_[p.surface].shading;
    const Vector3f n = points_.ns.vector(i);
    // What is left of light from a direction.
    const auto shadowing = [&](const Vector3f& w) {
      const Vector3f v = shading.to_local(w);
      return p.tilt.agrees(v, {0, 0, dot(n, w)}) ? p.tilt.shadowing(v) : 0.0f;
    };
    const float lit = shadowing(lights_.wi.vector(i)), next = shadowing(scattering_.wi.vector(i));
    lights_.value.set(i, lights_.value.vector(i) * lit);
    scattering_.weight.set(i, scattering_.weight.vector(i) * next);
    if (next == 0) scattering_.alive[i] = 0;
    points_.ns.set(i, shading.n);
  }
}

}  // namespace duet
