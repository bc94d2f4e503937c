// Several cameras side by side on one film.
#pragma once

#include <memory>
#include <vector>

#include "cameras/camera.h"

namespace duet {

/// Each camera has a strip of the film, from the left. What several of them see could be connected
/// with one only, so that no point of the scene is.
class CameraBatch final : public Camera {
 public:
  /// One camera at least, each made for a film of `strip` pixels across.
  CameraBatch(std::vector<std::unique_ptr<Camera>> cameras, int strip);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  std::optional<NextRays> next_rays(const Point2f& film, const Point2f& lens) const override;
  bool connectible() const override { return false; }
  float importance(const Ray&, float) const override { return 0; }
  std::optional<CameraSample> sample_lens(const Point3f&, const Point2f&) const override {
    return std::nullopt;
  }
  bool has_lens() const override { return has_lens_; }
  void surround(const Point3f& center, float radius) override {
    for (const auto& camera : cameras_) camera->surround(center, radius);
  }

 private:
  /// The camera that sees a film position, which becomes one of its own film.
  const Camera& camera_at(Point2f& film) const;

  std::vector<std::unique_ptr<Camera>> cameras_;
  float strip_;
  bool has_lens_ = false;
};

}  // namespace duet
