#include "lights/beam.h"

namespace duet {

CollimatedBeam::CollimatedBeam(const Transform& to_world, const Spectrum& power)
    : ray_{to_world(Point3f(0)), normalize(to_world(Vector3f(0, 0, 1))), INFINITY}, power_(power) {}

std::optional<EmissionSample> CollimatedBeam::sample_emission(const Point2f&,
                                                              const Point2f&) const {
  if (power_.is_black()) return std::nullopt;
  return EmissionSample{ray_, power_, 1, ShapePoint{}};
}

DirectionalArea::DirectionalArea(const Shape& shape, const ColorSlot& flux)
    : shape_(shape), points_(shape), flux_(flux), area_(surface_area(shape)) {}

double DirectionalArea::power(double) const {
  return area_ * double(flux_.average().luminance());
}

std::optional<EmissionSample> DirectionalArea::sample_emission(const Point2f& position,
                                                               const Point2f&) const {
  const ShapePoint p = points_.sample(position);
  Surface s;
  s.position = p.position;
  s.ng = p.ng;
  s.offset = p.offset;
  s.shading = Frame(p.ns);
  s.uv = p.uv;
  s.barycentric = p.barycentric;
  s.primitive = p.primitive;
  s.shape = &shape_;
  const Spectrum flux = flux_(s);
  if (flux.is_black()) return std::nullopt;
  EmissionSample e;
  e.ray = {p.position + Vector3f(p.ng) * p.offset, Vector3f(p.ns), INFINITY};
  e.weight = flux * float(area_);
  e.density = float(1 / area_);
  e.point = p;
  return e;
}

}  // namespace duet
