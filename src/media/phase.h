// Phase function interface: how a medium distributes what it scatters over directions.
#pragma once

#include "math/frame.h"
#include "math/measure.h"

namespace duet {

struct PhaseSample {
  Vector3f wi;  ///< unit
  PdfW pdf;     ///< zero if there is no such direction
};

/// Directions are unit vectors in world space that point away from the point of scattering: wo to
/// where the path comes from, wi to where it goes, so that −wo·wi is the cosine of the deflection.
/// Every phase function integrates to one and is sampled exactly: its value is its density.
class PhaseFunction {
 public:
  virtual ~PhaseFunction() = default;
  virtual PdfW eval(const Point3f& p, const Vector3f& wo, const Vector3f& wi) const = 0;
  /// `u` picks one of several functions, `v` the direction.
  virtual PhaseSample sample(const Point3f& p, const Vector3f& wo, float u,
                             const Point2f& v) const = 0;
  /// Whether extinction() is something else than one.
  virtual bool is_microflake() const { return false; }
  /// Factor of the medium's extinction for light along `w`: the area that particles turn to it.
  virtual float extinction(const Point3f&, const Vector3f&) const { return 1; }
  virtual float max_extinction() const { return 1; }
  /// Whether extinction() differs from place to place.
  virtual bool extinction_varies() const { return false; }
};

/// The direction that makes an angle of the given cosine with straight on; `u` turns it around.
Vector3f deflected(const Vector3f& wo, float cosine, float u);

}  // namespace duet
