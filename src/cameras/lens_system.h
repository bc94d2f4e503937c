// Lenses as their makers describe them: spherical surfaces one behind the other, and a stop.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cameras/lens_stop.h"

namespace duet {

/// One surface of a lens system, or its stop. All lengths have the same unit.
struct LensSurface {
  double radius = 0;     ///< of the sphere; positive: its centre lies towards the film; 0: the stop
  double thickness = 0;  ///< the distance along the axis to the next one towards the film
  double ior = 1;        ///< of what lies behind it, towards the film
  double aperture = 0;   ///< the radius of its rim
  bool operator==(const LensSurface&) const = default;
};

/// A ray in the space of a lens system, in double precision: surfaces are small, and scenes far.
struct LensRay {
  std::array<double, 3> origin, direction;  ///< the direction has unit length
};

/// The space of a lens system has the film's centre at its origin and the scene along +z.
class LensSystem {
 public:
  /// The surfaces follow each other from the scene to the film; there is one at least. The
  /// thickness of the last one is its distance from the film.
  explicit LensSystem(std::vector<LensSurface> surfaces, LensStop stop = {});

  /// The distance from the last surface to the film with which what lies `distance` before the film
  /// is sharp. Nothing if there is none: it is too near, or the surfaces do not converge light.
  /// Source: Gaussian optics, the system's matrix for rays near the axis.
  std::optional<double> film_distance_for(double distance) const;
  void set_film_distance(double distance);

  /// How much of the light along a ray from the film passes; `ray` becomes what leaves towards the
  /// scene. The surfaces neither reflect nor absorb: 0, or what the stop lets pass.
  double trace(LensRay& ray) const;
  /// Whether it would if the stop were open as far as its shape reaches.
  bool passes_rims(LensRay ray) const;

  double film_distance() const { return surfaces_.back().thickness; }
  /// The radius of the surface next to the film.
  double rear_aperture() const { return surfaces_.back().aperture; }

 private:
  /// A surface as rays from the film meet it.
  struct Meeting {
    double z;       ///< of the vertex
    double radius;  ///< as above
    double rim2;    ///< the square of the largest distance from the axis
    double ratio;   ///< of the refractive indices, film side over scene side
    double unit;    ///< one over the aperture
  };
  static bool meet_stop(const Meeting& m, LensRay& ray);
  static bool refract_at(const Meeting& m, LensRay& ray);
  void place();

  std::vector<LensSurface> surfaces_;
  LensStop stop_;
  std::vector<Meeting> meetings_;  ///< from the film to the scene
};

/// Bounds of where light from the film can leave the surface next to it: per distance from the
/// film's centre a rectangle in the plane of that surface's vertex.
/// Source: Pharr, Jakob & Humphreys, "Physically Based Rendering", 4th ed. 2023, section 5.4; found
/// by following where the pupil moves instead of by many samples.
class ExitPupil {
 public:
  /// For a film point on the x axis; symmetric in y.
  struct Box {
    double x0 = 0, x1 = 0, y = 0;
    bool empty() const { return !(x1 > x0 && y > 0); }
    double area() const { return empty() ? 0 : (x1 - x0) * 2 * y; }
  };

  /// `film_radius`: the largest distance of a film point from the centre.
  ExitPupil(const LensSystem& lens, double film_radius);

  /// The rectangle for film points at a distance from the centre.
  const Box& at(double distance) const;
  /// That for the film's centre, without margins.
  const Box& axis() const { return axis_; }
  /// Whether light passes the lenses at all.
  bool empty() const;

 private:
  static constexpr int kBoxes = 64;

  double film_radius_;
  Box axis_;
  std::vector<Box> boxes_;
};

}  // namespace duet
