#include "cameras/realistic.h"

#include <cmath>

namespace duet {

namespace {

/// The area of pbrt-v3's bounds for the film's centre, by which it divides: from 2^20 samples of a
/// square three times as wide as the rear surface, with a margin of twice their mean spacing.
double bounds_on_axis(const ExitPupil& pupil, const LensSystem& lens) {
  const double margin = 2 * std::hypot(3.0, 3.0) * lens.rear_aperture() / 1024;
  return sqr(2 * (pupil.axis().y + margin));
}

}  // namespace

RealisticCamera::RealisticCamera(const Transform& to_world, const Point2i& film, double diagonal,
                                 LensSystem lens, bool relative_to_pupil)
    : to_world_(to_world),
      lens_(std::move(lens)),
      pixel_(diagonal / std::hypot(double(film.x), double(film.y))),
      center_x_(0.5 * film.x),
      center_y_(0.5 * film.y),
      pupil_(lens_, 0.5 * diagonal),
      weight_(1 /
              (relative_to_pupil ? bounds_on_axis(pupil_, lens_) : sqr(lens_.film_distance()))) {}

CameraRay RealisticCamera::sample_ray(const Point2f& film, const Point2f& lens) const {
  // The image on the film is upside down, and its left is the film's right.
  const double x = (double(film.x) - center_x_) * pixel_, y = (double(film.y) - center_y_) * pixel_;
  const double distance = std::hypot(x, y), depth = lens_.film_distance();
  const ExitPupil::Box& box = pupil_.at(distance);
  const double px = box.x0 + (box.x1 - box.x0) * double(lens.x),
               py = (2 * double(lens.y) - 1) * box.y;
  // The rectangle turns with the film point.
  const double c = distance > 0 ? x / distance : 1, s = distance > 0 ? y / distance : 0;
  const double dx = c * px - s * py - x, dy = s * px + c * py - y;
  const double inverse = 1 / std::sqrt(dx * dx + dy * dy + depth * depth), cosine = depth * inverse;
  LensRay ray{{x, y, 0}, {dx * inverse, dy * inverse, cosine}};
  const double passed = box.empty() ? 0 : lens_.trace(ray);
  if (passed == 0)
    return {{to_world_(Point3f(0)), normalize(to_world_(Vector3f(0, 0, 1))), INFINITY}, 0};
  const auto& o = ray.origin;
  const auto& w = ray.direction;
  return {{to_world_(Point3f(float(o[0]), float(o[1]), float(o[2]))),
           normalize(to_world_(Vector3f(float(w[0]), float(w[1]), float(w[2])))), INFINITY},
          float(passed * weight_ * box.area() * sqr(sqr(cosine)))};
}

std::optional<NextRays> RealisticCamera::next_rays(const Point2f& film, const Point2f& lens) const {
  const CameraRay right = sample_ray({film.x + 1, film.y}, lens),
                  below = sample_ray({film.x, film.y + 1}, lens);
  if (right.weight == 0 || below.weight == 0) return std::nullopt;
  return NextRays{right, below};
}

}  // namespace duet
