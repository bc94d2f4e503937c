// Surfaces that emit.
#pragma once

#include <memory>

#include "lights/emissive_mesh.h"
#include "lights/emitting_side.h"
#include "lights/flat_light.h"
#include "lights/light.h"
#include "lights/mesh_light.h"
#include "lights/sphere_light.h"
#include "textures/texture.h"

namespace duet {

/// Emits the same radiance into all directions on a side, or on both.
class AreaLight final : public SurfaceLight {
 public:
  /// `shape` must outlive the light and stay where it is; its area must not be zero.
  /// `selection` is by what light samples choose a triangle of a mesh; they do so by what it
  /// emits unless a tree serves.
  AreaLight(const Shape& shape, const ColorSlot& radiance,
            EmittingSide side = EmittingSide::shading,
            LightSelection selection = LightSelection::automatic);

  [[gnu::always_inline]] std::optional<LightSample> sample_direct(const Point3f& from,
                                                                  const Point2f& u) const override {
    return flat_.area > 0 ? sample_flat(from, u) : sample_shape(from, u);
  }
  Spectrum emitted(const Surface& surface, const Vector3f& w) const override;
  PdfW pdf_direct(const Point3f& from, const Surface& surface, const Vector3f& wi,
                  float d2) const override;
  double power(double scene_radius) const override;
  std::optional<LightBounds> bounds() const override;
  /// A point in proportion to what it emits, and a direction by its cosine with the geometric
  /// normal. Of a sphere the direction comes first.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  std::optional<Point2f> direction_numbers(const Vector3f& w) const override;
  float direct_density(const EmissionSample& emission, const Point3f& at) const override;
  float emission_density(const Surface& surface, const Vector3f& w) const override;
  /// Total area of the surface.
  double area() const { return area_; }
  /// The light as such, or null if it is none.
  const FlatLight* flat() const { return flat_.area > 0 ? &flat_ : nullptr; }
  /// The light as such if its radiance is the same everywhere, or null.
  const SphereLight* sphere() const {
    return strategy_ == Strategy::cone && radiance_.is_constant() ? &sphere_ : nullptr;
  }
  /// What chooses points of a mesh whose radiance is the same everywhere, or null.
  const EmissiveMesh* mesh() const {
    return mesh_ && radiance_.is_constant() ? mesh_.get() : nullptr;
  }
  /// The light as such, if mesh() is not null.
  MeshLight mesh_light() const;
  const Shape& shape() const { return shape_; }

 private:
  /// How points are chosen.
  enum class Strategy {
    mesh,           ///< a triangle, then a point of it
    parallelogram,  ///< two triangles that are one, taken as a whole to keep strata together
    cone,           ///< a sphere: a direction within the cone that it fills, any for emission
    surface,        ///< an analytic shape by its parameters
  };

  /// The density of a direction in which light leaves, per cosine: that of its side, too.
  float direction_density() const { return two_sided() ? 0.5f * kInvPi : kInvPi; }
  bool two_sided() const { return side_ == EmittingSide::both; }
  /// Whether light leaves a point in a direction on the side of its geometric normal.
  bool leaves(const Normal3f& shading, const Vector3f& w) const {
    return side_ != EmittingSide::shading || dot(shading, w) > 0;
  }
  bool choose_cone();
  bool choose_parallelogram();
  void make_flat_disk();
  EmissiveMesh::DirectPoint direct_point(const Point3f& from, const Point2f& u) const;
  /// The radiance of a point on the side that shines.
  Spectrum radiance(const ShapePoint& p) const;
  LightSample light_sample(const ShapePoint& p, const SeenPoint& seen) const;
  std::optional<LightSample> sample_flat(const Point3f& from, const Point2f& u) const;
  std::optional<LightSample> sample_shape(const Point3f& from, const Point2f& u) const;
  std::optional<LightSample> sample_cone(const Point3f& from, const Point2f& u) const;
  /// The point of the sphere with this normal.
  ShapePoint point_of_sphere(const Normal3f& n) const;
  /// Where emitted rays start, unless from a sphere.
  ShapePoint sample_point(const Point2f& u) const;
  struct EmittedRay {
    ShapePoint start;
    Vector3f direction;
  };
  EmittedRay leave_point(const Point2f& position, Point2f direction) const;
  EmittedRay leave_sphere(const Point2f& position, const Point2f& direction) const;
  /// The density with which sample_point() makes a point of the surface.
  PdfA point_pdf(const Surface& surface) const;

  const Shape& shape_;
  ColorSlot radiance_;
  EmittingSide side_;
  Strategy strategy_;
  double area_;
  PdfA uniform_;                              ///< 1 / area
  std::unique_ptr<const EmissiveMesh> mesh_;  ///< of Strategy::mesh
  FlatLight flat_;                            ///< of area 0 if the light is none
  SphereLight sphere_;                        ///< of Strategy::cone
};

// The most frequent lights are looked into by whoever asks them: the sample then stays in
// registers.
[[gnu::always_inline]] inline std::optional<LightSample> AreaLight::sample_flat(
    const Point3f& from, const Point2f& u) const {
  const FlatLight::Sample s = flat_.sample(from, u);
  if (!(s.facing > 0)) return std::nullopt;
  std::optional<LightSample> sample(std::in_place);
  sample->wi = s.wi;
  sample->target = s.target;
  sample->weight = flat_.radiance * s.solid_angle;
  sample->pdf = PdfW{s.pdf};
  sample->emission = uniform_.value * kInvPi;
  return sample;
}

}  // namespace duet
