// All phase functions.
#pragma once

#include <span>

#include "math/distribution.h"
#include "media/phase.h"
#include "media/volume.h"

namespace duet {

class Isotropic final : public PhaseFunction {
 public:
  PdfW eval(const Point3f&, const Vector3f&, const Vector3f&) const override;
  PhaseSample sample(const Point3f&, const Vector3f&, float, const Point2f& v) const override;
};

/// Source: Henyey & Greenstein, "Diffuse radiation in the galaxy", 1941. `g` lies in (−1, 1).
class HenyeyGreenstein final : public PhaseFunction {
 public:
  explicit HenyeyGreenstein(float g) : g_(g) {}
  PdfW eval(const Point3f&, const Vector3f& wo, const Vector3f& wi) const override;
  PhaseSample sample(const Point3f&, const Vector3f& wo, float, const Point2f& v) const override;

 private:
  PdfW density(float cosine) const;
  float g_;
};

/// Scattering by particles much smaller than the wavelength: 3/(16π) (1 + cos² θ).
class Rayleigh final : public PhaseFunction {
 public:
  PdfW eval(const Point3f&, const Vector3f& wo, const Vector3f& wi) const override;
  PhaseSample sample(const Point3f&, const Vector3f& wo, float, const Point2f& v) const override;
};

/// Linear between values at equidistant cosines of the deflection, from −1 to 1.
class Tabulated final : public PhaseFunction {
 public:
  /// At least two finite values ≥ 0 that are not all zero.
  explicit Tabulated(std::span<const double> values);
  PdfW eval(const Point3f&, const Vector3f& wo, const Vector3f& wi) const override;
  PhaseSample sample(const Point3f&, const Vector3f& wo, float, const Point2f& v) const override;

 private:
  std::vector<float> density_;  ///< at the nodes, per solid angle
  DiscreteDistribution intervals_;
};

/// Mirror-like flakes whose normals are distributed like those of an ellipsoid.
/// Source: Heitz, Dupuy, Crassin & Dachsbacher, "The SGGX Microflake Distribution", 2015.
class Sggx final : public PhaseFunction {
 public:
  explicit Sggx(const MatrixVolume& matrix);
  PdfW eval(const Point3f& p, const Vector3f& wo, const Vector3f& wi) const override;
  PhaseSample sample(const Point3f& p, const Vector3f& wo, float, const Point2f& v) const override;
  bool is_microflake() const override { return true; }
  float extinction(const Point3f& p, const Vector3f& w) const override;
  float max_extinction() const override { return max_extinction_; }
  bool extinction_varies() const override { return matrix_.grid != nullptr; }

 private:
  MatrixVolume matrix_;
  float max_extinction_;
};

/// (1 − weight) · first + weight · second, with the weight clamped to [0, 1].
class BlendedPhase final : public PhaseFunction {
 public:
  BlendedPhase(const FloatVolumeSlot& weight, const PhaseFunction& first,
               const PhaseFunction& second)
      : weight_(weight), first_(first), second_(second) {}
  PdfW eval(const Point3f& p, const Vector3f& wo, const Vector3f& wi) const override;
  PhaseSample sample(const Point3f& p, const Vector3f& wo, float u,
                     const Point2f& v) const override;

 private:
  FloatVolumeSlot weight_;
  const PhaseFunction &first_, &second_;
};

}  // namespace duet
