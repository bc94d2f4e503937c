// An environment whose light samples know where it is seen.
#pragma once

#include <memory>

#include "lights/environment_guide.h"

namespace duet {

/// Light sub-paths begin as those of the environment itself.
class GuidedEnvironment final : public EnvironmentLight {
 public:
  GuidedEnvironment(std::unique_ptr<EnvironmentLight> environment, EnvironmentGuide guide)
      : environment_(std::move(environment)), guide_(std::move(guide)) {}

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override {
    return guide_.sample_direct(*environment_, from, u);
  }
  Spectrum emitted(const Point3f& from, const Vector3f& wi) const override {
    return environment_->emitted(from, wi);
  }
  PdfW pdf_direct(const Point3f& from, const Vector3f& wi) const override {
    return guide_.pdf(*environment_, from, wi);
  }
  double power(double scene_radius) const override { return environment_->power(scene_radius); }
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override {
    return environment_->sample_emission(position, direction);
  }
  float emission_density(const Vector3f& wi) const override {
    return environment_->emission_density(wi);
  }
  void surround(const Point3f& center, float radius) override {
    environment_->surround(center, radius);
  }
  const SceneSphere* entered_sphere() const override { return environment_->entered_sphere(); }

 private:
  std::unique_ptr<EnvironmentLight> environment_;
  EnvironmentGuide guide_;
};

}  // namespace duet
