// How light sub-paths begin: at which light, and with which ray.
#pragma once

#include "lights/emission_guide.h"
#include "scene/scene.h"

namespace duet {

/// The choice of a light and of a ray that leaves it, with its density; refers to the scene and to
/// the guide, if there is one.
class LightStarts {
 public:
  explicit LightStarts(const Scene& scene, const EmissionGuide* guide = nullptr)
      : scene_(&scene), guide_(guide) {}

  LightPicker::Pick pick(float choice, const Point2f& position) const {
    return guide_ ? guide_->pick(choice, position) : scene_->emission_picker.pick(choice, position);
  }
  /// A ray of the light; empty if it carries nothing.
  std::optional<EmissionSample> emit(uint32_t light, const Point2f& position,
                                     const Point2f& direction) const {
    const Light& emitter = *scene_->lights[light];
    return guide_ ? guide_->emit(light, emitter, position, direction)
                  : emitter.sample_emission(position, direction);
  }
  /// The density of the choice of a light and of its ray through a point. `emission` is what the
  /// light says of it (EmissionSample::density), `from` the unit direction towards the light.
  float density(uint32_t light, float emission, const Vector3f& from,
                const Point3f& through) const {
    if (!guide_) return emission * scene_->emission_picker.probability(light);
    return emission * guide_->probability(light) *
           guide_->factor(light, *scene_->lights[light], from, through);
  }

 private:
  const Scene* scene_;
  const EmissionGuide* guide_;
};

}  // namespace duet
