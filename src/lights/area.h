// Surfaces that emit.
#pragma once

#include <memory>

#include "lights/light.h"
#include "lights/light_tree.h"
#include "lights/triangle_cells.h"
#include "textures/texture.h"

namespace duet {

/// A light that is a flat parallelogram and shines on one side, the same everywhere: light samples
/// of it have a closed form, which is also that of many points at once.
struct ParallelogramLight {
  Point3f corner;  ///< just off its surface
  Vector3f edge_u, edge_v;
  Normal3f normal;
  Spectrum radiance;
  float area = 0;

  /// A light sample without the radiance.
  struct Sample {
    Point3f target;
    Vector3f wi;
    float facing;  ///< positive if the light is seen from its side; the rest is valid only then
    float solid_angle;  ///< area · cos θ / d²
    float pdf;          ///< per solid angle
  };
  [[gnu::always_inline]] Sample sample(const Point3f& from, const Point2f& u) const {
    Sample s;
    s.target = corner + (edge_u * u.x + edge_v * u.y);
    const Vector3f d = s.target - from;
    s.facing = -dot(normal, d);
    const float d2 = length_squared(d), distance = std::sqrt(d2), inv_distance = 1 / distance;
    // what a density per area becomes per solid angle
    const float projected = s.facing * area;
    s.solid_angle = projected * inv_distance * inv_distance * inv_distance;
    s.wi = d * inv_distance;
    s.pdf = d2 * distance / projected;
    return s;
  }
};

/// Emits the same radiance into all directions on the side of the shading normal, or on both sides.
class AreaLight final : public SurfaceLight {
 public:
  /// `shape` must outlive the light and stay where it is; its area must not be zero.
  /// `selection` is by what light samples choose a triangle of a mesh; they do so by what it
  /// emits unless a tree serves.
  AreaLight(const Shape& shape, const ColorSlot& radiance, bool two_sided = false,
            LightSelection selection = LightSelection::automatic);

  [[gnu::always_inline]] std::optional<LightSample> sample_direct(const Point3f& from,
                                                                  const Point2f& u) const override {
    return strategy_ == Strategy::parallelogram ? sample_parallelogram(from, u)
                                                : sample_shape(from, u);
  }
  Spectrum emitted(const Surface& surface, const Vector3f& w) const override;
  PdfW pdf_direct(const Point3f& from, const Surface& surface, const Vector3f& wi,
                  float d2) const override;
  double power(double scene_radius) const override;
  std::optional<LightBounds> bounds() const override;
  /// A point in proportion to what it emits, and a direction by its cosine with the geometric
  /// normal.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  float direct_density(const EmissionSample& emission, const Point3f& at) const override;
  float emission_density(const Surface& surface, const Vector3f& w) const override;
  /// Total area of the surface.
  double area() const { return area_; }
  /// The light as such, or null if it is none.
  const ParallelogramLight* parallelogram() const {
    return strategy_ == Strategy::parallelogram ? &parallelogram_ : nullptr;
  }

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
  void make_tree();
  LightBounds triangle_bounds(uint32_t triangle) const;
  /// A light sample's point, with the density of sample_point() there, and its own density.
  struct DirectPoint {
    ShapePoint point;
    PdfA pdf;
  };
  DirectPoint direct_point(const Point3f& from, const Point2f& u) const;
  DirectPoint point_by_tree(const Point3f& from, const Point2f& u) const;
  /// The density with which a light sample at `from` chooses a point of a mesh by the tree.
  PdfA tree_pdf(const Point3f& from, uint32_t triangle, const Point2f& barycentric) const;
  /// The radiance of a point on the side that shines.
  Spectrum radiance(const ShapePoint& p) const;
  LightSample toward(const ShapePoint& p, PdfW pdf, const Vector3f& wi) const;
  std::optional<LightSample> sample_parallelogram(const Point3f& from, const Point2f& u) const;
  std::optional<LightSample> sample_shape(const Point3f& from, const Point2f& u) const;
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
  std::unique_ptr<const LightTree> tree_;  ///< over the triangles of a mesh, or null
  ParallelogramLight parallelogram_;
  Point3f center_;  ///< of the sphere
  float radius_ = 0;
};

// The most frequent light is looked into by whoever asks it: the sample then stays in registers.
[[gnu::always_inline]] inline std::optional<LightSample> AreaLight::sample_parallelogram(
    const Point3f& from, const Point2f& u) const {
  const ParallelogramLight::Sample s = parallelogram_.sample(from, u);
  if (!(s.facing > 0)) return std::nullopt;
  std::optional<LightSample> sample(std::in_place);
  sample->wi = s.wi;
  sample->target = s.target;
  sample->weight = parallelogram_.radiance * s.solid_angle;
  sample->pdf = PdfW{s.pdf};
  sample->emission = uniform_.value * kInvPi;
  return sample;
}

}  // namespace duet
