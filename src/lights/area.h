// Surfaces that emit.
#pragma once

#include "lights/light.h"
#include "lights/triangle_cells.h"
#include "textures/texture.h"

namespace duet {

/// Emits the same radiance into all directions on the side of the shading normal, or on both sides.
class AreaLight final : public SurfaceLight {
 public:
  /// `shape` must outlive the light and stay where it is; its area must not be zero.
  AreaLight(const Shape& shape, const ColorSlot& radiance, bool two_sided = false);

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  Spectrum emitted(const Surface& surface, const Vector3f& w) const override;
  PdfW pdf_direct(const Point3f& from, const Surface& surface, const Vector3f& wi,
                  float d2) const override;
  double power(double scene_radius) const override;
  /// A point in proportion to what it emits, and a direction by its cosine with the geometric
  /// normal.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  float direct_density(const EmissionSample& emission, const Point3f& at) const override;
  float emission_density(const Surface& surface, const Vector3f& w) const override;
  /// Total area of the surface.
  double area() const { return area_; }

 private:
  /// How points are chosen.
  enum class Strategy {
    cells,          ///< a triangle by the light it emits, then a point of it
    parallelogram,  ///< two triangles that are one, taken as a whole to keep strata together
    cone,           ///< a sphere: a direction within the cone that it fills; by area for emission
    surface,        ///< an analytic shape by its parameters
  };

  /// The density of a direction in which light leaves, per cosine: that of its side, too.
  float direction_density() const { return two_sided_ ? 0.5f * kInvPi : kInvPi; }
  bool choose_cone();
  bool choose_parallelogram();
  /// The radiance of a point on the side that shines.
  Spectrum radiance(const ShapePoint& p) const;
  LightSample toward(const ShapePoint& p, PdfW pdf, const Vector3f& wi) const;
  std::optional<LightSample> sample_parallelogram(const Point3f& from, const Point2f& u) const;
  std::optional<LightSample> sample_cone(const Point3f& from, const Point2f& u) const;
  /// The density of any direction that sample_cone() makes.
  PdfW cone_pdf(const Point3f& from) const;
  /// Where emitted rays start.
  ShapePoint sample_point(const Point2f& u) const;
  /// The density with which sample_point() makes a point of the surface.
  PdfA point_pdf(const Surface& surface) const;

  const Shape& shape_;
  ColorSlot radiance_;
  bool two_sided_;
  Strategy strategy_;
  double area_;
  PdfA uniform_;  ///< 1 / area
  std::optional<TriangleCells> cells_;
  Point3f corner_;  ///< of the parallelogram, just off its surface
  Vector3f edge_u_, edge_v_;
  Normal3f normal_;
  Point3f center_;  ///< of the sphere
  float radius_ = 0;
};

}  // namespace duet
