#include "integrators/method_rules.h"

namespace duet {

MethodRules method_rules(const SceneFeatures& f) {
  const size_t near_lights =
      f.area_lights + f.point_lights + f.spot_lights + f.projectors + f.beams;
  const bool delta_lights =
      f.point_lights + f.spot_lights + f.projectors + f.directional_lights > 0;
  MethodRules rules;
  rules.has_media = f.media > 0;
  rules.has_heterogeneous_media = f.heterogeneous_media > 0;
  rules.skips_passed_surfaces = rules.has_media || f.skips_masks;
  // A surface that lets light pass unchanged stops light samples as glass does where it counts.
  const bool delta_surfaces =
      f.mirrors + f.smooth_glass > 0 || (f.masks > 0 && !rules.skips_passed_surfaces);
  rules.has_lights = near_lights + f.far_lights() + f.emissive_media > 0;
  rules.needs_light_subpaths = (delta_lights && delta_surfaces) || f.beams > 0;
  rules.may_merge =
      rules.has_lights && (delta_surfaces || f.rough_reflection + f.rough_refraction > 0);
  rules.far_lights_only = rules.has_lights && near_lights + f.emissive_media == 0;
  return rules;
}

Obstacle find_obstacle(const SceneLimits& scene,
                       const decltype(IntegratorDescription::method)& method) {
  const auto* d = std::get_if<BidirectionalIntegratorDescription>(&method);
  if (!d) return Obstacle::none;
  using enum BidirectionalMethod;
  const bool is_thesis = d->method == reuse && d->weights != ReuseWeights::exact;
  if (scene.emissive_media) return Obstacle::emissive_media;
  if (scene.media && (d->method == ppm || d->method == bpm)) return Obstacle::media;
  if ((scene.media || scene.skips_masks) && is_thesis) return Obstacle::media;
  if (scene.one_way_surfaces) return Obstacle::one_way_surfaces;
  if (!scene.connectible && (d->method == ptracer || d->method == reuse)) return Obstacle::sensor;
  return Obstacle::none;
}

std::string describe(const MethodRules& rules) {
  if (!rules.has_lights) return "no lights";
  std::string text =
      rules.needs_light_subpaths
          ? "light sub-paths are needed (lights that no ray finds, specular surfaces)"
          : "light sub-paths are not needed";
  text += rules.may_merge ? ", merging may be (specular or glossy surfaces)"
                          : ", nor is merging (no specular or glossy surfaces)";
  if (rules.far_lights_only) text += "; all lights are far away";
  if (rules.has_media)
    text += rules.has_heterogeneous_media ? "; media with grids" : "; media without grids";
  return text;
}

}  // namespace duet
