#include "lights/area.h"

#include "math/equal_area.h"
#include "math/warp.h"

namespace duet {

namespace {

/// Corner and edges of the parallelogram that two triangles make together, if they do, and shine on
/// one side of it.
std::optional<FlatLight> find_parallelogram(const TriangleMesh& m) {
  if (m.triangles.size() != 2) return std::nullopt;
  // Normals that differ would make the emitting side vary.
  for (const Normal3f& n : m.normals)
    if (!(dot(n, m.normals[0]) > 0.9999f)) return std::nullopt;
  const auto corner = [&](size_t triangle, size_t i) {
    return m.positions[m.triangles[triangle][i % 3]];
  };
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      // (a b d) and (c d b) share the diagonal.
      const Point3f a = corner(0, i), b = corner(0, i + 1), d = corner(0, i + 2), c = corner(1, j);
      if (corner(1, j + 1) != d || corner(1, j + 2) != b) continue;
      const Vector3f u = b - a, v = d - a;
      const float size = std::max(max_abs(u), max_abs(v));
      if (max_abs((c - d) - u) <= 1e-5f * size) return FlatLight{a, u, v, {}, {}};
    }
  return std::nullopt;
}

}  // namespace

AreaLight::AreaLight(const Shape& shape, const ColorSlot& radiance, EmittingSide side,
                     LightSelection selection)
    : shape_(shape),
      radiance_(radiance),
      side_(side),
      area_(surface_area(shape)),
      uniform_{float(1 / area_)} {
  // Of two sides, either may be the one that is seen.
  if (shape.kind != ShapeKind::mesh) {
    strategy_ = !two_sided() && choose_cone() ? Strategy::cone : Strategy::surface;
    if (shape.kind == ShapeKind::disk && !two_sided() && radiance.is_constant()) make_flat_disk();
  } else if (!two_sided() && radiance.is_constant() && choose_parallelogram()) {
    strategy_ = Strategy::parallelogram;
  } else {
    strategy_ = Strategy::mesh;
    mesh_ = std::make_unique<EmissiveMesh>(shape, radiance, two_sided(), selection);
  }
}

bool AreaLight::choose_cone() {
  // A sphere that is not stretched and shines outwards.
  if (shape_.kind != ShapeKind::sphere || shape_.flip_normals != shape_.to_world.mirrors())
    return false;
  const auto& rows = shape_.to_world.rows();
  const auto column = [&](size_t j) { return Vector3f(rows[0][j], rows[1][j], rows[2][j]); };
  const Vector3f x = column(0), y = column(1), z = column(2);
  const float r2 = length_squared(x);
  for (const float off :
       {length_squared(y) - r2, length_squared(z) - r2, dot(x, y), dot(y, z), dot(z, x)})
    if (!(std::abs(off) < 1e-5f * r2)) return false;
  sphere_.center = shape_.to_world(Point3f(0, 0, 0));
  sphere_.radius = std::sqrt(r2);
  if (radiance_.is_constant()) sphere_.radiance = radiance_.constant;
  sphere_.offset = kOffsetScale * (max_abs(sphere_.center) + sphere_.radius);
  sphere_.emission = uniform_.value * direction_density();
  return true;
}

bool AreaLight::choose_parallelogram() {
  const auto p = find_parallelogram(*shape_.mesh);
  if (!p) return false;
  const ShapePoint first = point_on_triangle(shape_, 0, {0.3f, 0.3f}),
                   second = point_on_triangle(shape_, 1, {0.3f, 0.3f});
  // Normals that lean would darken a part of the directions.
  if (!(dot(first.ng, first.ns) > 0.9999f)) return false;
  const Vector3f off = Vector3f(first.ng) * std::max(first.offset, second.offset);
  flat_ = {p->origin + off, p->edge_u, p->edge_v, first.ng, radiance_.constant, float(area_)};
  return true;
}

void AreaLight::make_flat_disk() {
  const auto& rows = shape_.to_world.rows();
  const auto column = [&](size_t j) { return Vector3f(rows[0][j], rows[1][j], rows[2][j]); };
  const ShapePoint center = sample_analytic(shape_, {0.5f, 0.5f});
  flat_ = {center.position + Vector3f(center.ng) * center.offset,
           column(0),
           column(1),
           center.ng,
           radiance_.constant,
           1 / center.pdf.value,
           1};
}

double AreaLight::power(double) const {
  const double emission =
      mesh_ ? mesh_->cells().integral() : area_ * double(radiance_.average().luminance());
  return double(kPi) * emission * (two_sided() ? 2 : 1);
}

std::optional<LightBounds> AreaLight::bounds() const {
  if (shape_.kind != ShapeKind::mesh) {
    LightBounds b = LightBounds::around(analytic_bounds(shape_));
    if (shape_.kind == ShapeKind::disk && !two_sided())
      b.normals = {Vector3f(sample_analytic(shape_, {0.5f, 0.5f}).ng)};
    return b;
  }
  if (mesh_ && mesh_->tree()) return mesh_->tree()->bounds();
  return mesh_light_bounds(shape_, two_sided());
}

Spectrum AreaLight::emitted(const Surface& surface, const Vector3f& w) const {
  const Normal3f& n = side_ == EmittingSide::geometric ? surface.ng : surface.shading.n;
  return two_sided() || dot(n, w) > 0 ? radiance_(surface) : Spectrum();
}

LightSample AreaLight::light_sample(const ShapePoint& p, const SeenPoint& seen) const {
  return {seen.wi, seen.target, radiance(p) / seen.pdf, PdfW{seen.pdf},
          p.pdf.value * direction_density()};
}

std::optional<LightSample> AreaLight::sample_shape(const Point3f& from, const Point2f& u) const {
  if (strategy_ == Strategy::cone) return sample_cone(from, u);
  const auto [p, pdf] = direct_point(from, u);
  const EmittingPoint point{p.position, Vector3f(p.ng), Vector3f(p.ns), p.offset};
  const SeenPoint s = SideFactors(side_).see(from, point, pdf.value);
  if (!(s.pdf > 0)) return std::nullopt;
  return light_sample(p, s);
}

inline EmissiveMesh::DirectPoint AreaLight::direct_point(const Point3f& from,
                                                         const Point2f& u) const {
  if (mesh_) return mesh_->sample_direct(from, u);
  const ShapePoint p = sample_analytic(shape_, u);
  return {p, p.pdf};
}

MeshLight AreaLight::mesh_light() const {
  const float even = mesh_->cells().pdf(0, {}).value;
  return {radiance_.constant, mesh_->tree() ? 0.0f : even, even * direction_density(),
          SideFactors(side_)};
}

Spectrum AreaLight::radiance(const ShapePoint& p) const {
  if (!radiance_.texture) return radiance_.constant;
  return radiance_(textured_point(shape_, p));
}

std::optional<LightSample> AreaLight::sample_cone(const Point3f& from, const Point2f& u) const {
  const SphereLight::Sample s = sphere_.sample(from, u);
  if (!(s.pdf > 0)) return std::nullopt;
  return light_sample(point_of_sphere(s.normal), {s.wi, s.target(sphere_), s.pdf});
}

ShapePoint AreaLight::point_of_sphere(const Normal3f& n) const {
  ShapePoint p;
  p.position = sphere_.center + Vector3f(n) * sphere_.radius;
  p.ng = p.ns = n;
  p.offset = sphere_.offset;
  p.pdf = uniform_;
  if (radiance_.texture) p.uv = analytic_uv(shape_.kind, shape_.to_world.inverse(p.position));
  return p;
}

inline PdfA AreaLight::point_pdf(const Surface& surface) const {
  if (mesh_) return mesh_->cells().pdf(surface.primitive, surface.barycentric);
  if (strategy_ != Strategy::surface) return uniform_;
  return pdf_analytic(shape_, normalize(shape_.to_world.inverse(surface.ng)));
}

PdfW AreaLight::pdf_direct(const Point3f& from, const Surface& surface, const Vector3f& wi,
                           float d2) const {
  const float facing = -dot(surface.ng, wi), cosine = two_sided() ? std::abs(facing) : facing;
  if (!(cosine > 0)) return {};
  if (strategy_ == Strategy::cone) return {sphere_.pdf(from)};
  const PdfA pdf =
      mesh_ ? mesh_->pdf_direct(from, surface.primitive, surface.barycentric) : point_pdf(surface);
  return to_solid_angle(pdf, d2, cosine);
}

ShapePoint AreaLight::sample_point(const Point2f& u) const {
  if (mesh_) return mesh_->cells().sample(u);
  if (strategy_ == Strategy::surface) return sample_analytic(shape_, u);
  ShapePoint p{};
  const FlatLight& l = flat_;
  p.position = l.origin + (l.edge_u * u.x + l.edge_v * u.y);
  p.ng = p.ns = l.normal;
  p.pdf = uniform_;
  return p;
}

inline AreaLight::EmittedRay AreaLight::leave_point(const Point2f& position, Point2f u) const {
  ShapePoint p = sample_point(position);
  if (two_sided()) {
    // Half of the directions for each side.
    const bool back = u.x >= 0.5f;
    if (back) p.ng = -p.ng, p.ns = -p.ns;
    u.x = std::min(2 * u.x - (back ? 1.0f : 0.0f), kBelowOne);
  }
  return {p, Frame(p.ng).to_world(square_to_cosine_hemisphere(u))};
}

// Both have the density of a uniform point and the cosine there: 1 / 4π for the direction, and one
// over the area of the disk that the sphere is across it.
inline AreaLight::EmittedRay AreaLight::leave_sphere(const Point2f& position,
                                                     const Point2f& direction) const {
  const Vector3f w = normalize(square_to_sphere_equal_area(direction));
  const Normal3f n(Frame(Normal3f(w)).to_world(square_to_cosine_hemisphere(position)));
  return {point_of_sphere(n), w};
}

std::optional<Point2f> AreaLight::direction_numbers(const Vector3f& w) const {
  if (strategy_ == Strategy::cone) return sphere_to_square_equal_area(w);
  if (!(flat_.area > 0)) return std::nullopt;
  const Vector3f local = Frame(flat_.normal).to_local(w);
  return disk_to_square({local.x, local.y});
}

std::optional<EmissionSample> AreaLight::sample_emission(const Point2f& position,
                                                         const Point2f& direction) const {
  const auto [p, w] = strategy_ == Strategy::cone ? leave_sphere(position, direction)
                                                  : leave_point(position, direction);
  if (!(dot(p.ng, w) > 0 && leaves(p.ns, w))) return std::nullopt;
  const Spectrum emitted = radiance(p);
  if (emitted.is_black()) return std::nullopt;
  // The cosine of the direction's density is that of the area across the ray.
  const float density = p.pdf.value * direction_density();
  const Point3f origin = p.position + Vector3f(p.ng) * p.offset;
  return EmissionSample{{origin, w, INFINITY}, emitted / density, density, p};
}

float AreaLight::emission_density(const Surface& surface, const Vector3f& w) const {
  const float side = two_sided() && dot(surface.ng, w) < 0 ? -1.0f : 1.0f;
  if (!(side * dot(surface.ng, w) > 0 && leaves(surface.shading.n, w))) return 0;
  return point_pdf(surface).value * direction_density();
}

float AreaLight::direct_density(const EmissionSample& emission, const Point3f& at) const {
  if (strategy_ == Strategy::cone) return sphere_.pdf(at);
  const ShapePoint& p = emission.point;
  const PdfA pdf = mesh_ ? mesh_->pdf_direct(at, p.primitive, p.barycentric) : p.pdf;
  return to_solid_angle(pdf, length_squared(p.position - at), dot(p.ng, emission.ray.direction))
      .value;
}

}  // namespace duet
