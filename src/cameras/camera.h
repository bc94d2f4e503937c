// Camera interface.
#pragma once

#include <optional>

#include "math/transform.h"
#include "math/vector.h"

namespace duet {

/// How a point of the scene is seen by the camera.
struct CameraSample {
  Point2f film;          ///< where, within the image
  Vector3f direction;    ///< unit, from the point towards the camera
  Point3f target;        ///< where the line to the camera meets the near clipping plane
  float importance = 0;  ///< see Camera::importance()
};

/// A ray into the scene.
struct CameraRay : Ray {
  CameraRay(const Ray& ray, float weight_ = 1) : Ray(ray), weight(weight_) {}
  float weight;  ///< what the radiance along it is to be multiplied by; may be zero
};

/// The rays through the film positions one pixel to the right and one below.
struct NextRays {
  Ray right, below;
};

/// A sensor in front of the scene. Film positions are in pixels of the full image, from the top
/// left.
class Camera {
 public:
  virtual ~Camera() = default;

  /// The ray through a film position and, for lenses, a point of the unit square on the aperture.
  /// It starts on the near and ends on the far clipping plane; its direction has unit length.
  virtual CameraRay sample_ray(const Point2f& film, const Point2f& lens) const = 0;

  /// The neighbours of sample_ray()'s ray, through the same point of the lens. Empty if the film
  /// shows no picture.
  virtual std::optional<NextRays> next_rays(const Point2f& film, const Point2f& lens) const {
    return NextRays{sample_ray({film.x + 1, film.y}, lens), sample_ray({film.x, film.y + 1}, lens)};
  }

  /// The density per unit area across `ray`, at the distance `t` from its start, with which film
  /// positions of density 1 per pixel area make rays through one point of the lens arrive there.
  virtual float importance(const Ray& ray, float t) const = 0;

  /// The line from a point to (a point of) the lens. Empty if the image does not show the point, or
  /// not between the clipping planes.
  virtual std::optional<CameraSample> sample_lens(const Point3f& from,
                                                  const Point2f& lens) const = 0;

  /// Whether `lens` matters.
  virtual bool has_lens() const { return false; }

  /// Whether points of the scene can be connected with the lens. If not, importance() and
  /// sample_lens() say nothing, and light is found from this side only.
  virtual bool connectible() const { return true; }

  /// Tells cameras that look from afar which sphere holds the scene, before any use.
  virtual void surround(const Point3f&, float) {}
};

}  // namespace duet
