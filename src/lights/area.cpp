#include "lights/area.h"

#include "math/warp.h"

namespace duet {

namespace {

/// The triangles (a b c), (a c d) of a parallelogram with texture coordinates that are none or
/// affine.
bool is_parallelogram(const TriangleMesh& m) {
  if (m.triangles.size() != 2 || m.positions.size() != 4 || !m.attributes.empty()) return false;
  const auto &s = m.triangles[0], &t = m.triangles[1];
  if (t[0] != s[0] || t[1] != s[2]) return false;
  const auto matches = [](const auto& a, const auto& b, const auto& c, const auto& d) {
    const auto e = (b - a) - (c - d);
    return std::max(std::abs(e.x), std::abs(e.y));
  };
  const Point3f &a = m.positions[s[0]], &b = m.positions[s[1]], &c = m.positions[s[2]],
                &d = m.positions[t[2]];
  const float size = std::max(max_abs(b - a), max_abs(c - b));
  if (!(max_abs((b - a) - (c - d)) <= 1e-5f * size)) return false;
  if (!m.uvs.empty() && !(matches(m.uvs[s[0]], m.uvs[s[1]], m.uvs[s[2]], m.uvs[t[2]]) <= 1e-5f))
    return false;
  // Normals that differ would make the emitting side vary.
  for (const Normal3f& n : m.normals)
    if (!(dot(n, m.normals[0]) > 0.9999f)) return false;
  return true;
}

}  // namespace

AreaLight::AreaLight(const Shape& shape, const ColorSlot& radiance)
    : shape_(shape), radiance_(radiance), area_(surface_area(shape)) {
  const auto& rows = shape.to_world.rows();
  const auto column = [&](int j) { return Vector3f(rows[0][j], rows[1][j], rows[2][j]); };
  if (shape.kind == ShapeKind::mesh) {
    const TriangleMesh& m = *shape.mesh;
    if (is_parallelogram(m)) {
      strategy_ = Strategy::parallelogram;
      const auto& t = m.triangles[0];
      corner_ = m.positions[t[0]];
      edge_u_ = m.positions[t[1]] - corner_;
      edge_v_ = m.positions[t[2]] - m.positions[t[1]];
      const ShapePoint p = sample_triangle(shape, 0, {0.5f, 0.5f});
      normal_ = p.ng;
      corner_ = corner_ + Vector3f(normal_) *
                              std::max(p.offset, sample_triangle(shape, 1, {0.5f, 0.5f}).offset);
    } else {
      strategy_ = Strategy::triangles;
      std::vector<float> areas(m.triangles.size());
      for (uint32_t i = 0; i < areas.size(); ++i) areas[i] = triangle_area(m, i);
      triangles_ = DiscreteDistribution(areas);
    }
  } else {
    strategy_ = Strategy::surface;
    const Vector3f x = column(0), y = column(1), z = column(2);
    const float r2 = length_squared(x), tolerance = 1e-5f * r2;
    const bool similar = std::abs(length_squared(y) - r2) < tolerance &&
                         std::abs(length_squared(z) - r2) < tolerance &&
                         std::abs(dot(x, y)) < tolerance && std::abs(dot(y, z)) < tolerance &&
                         std::abs(dot(z, x)) < tolerance;
    if (shape.kind == ShapeKind::sphere && similar && radiance.is_constant() &&
        !shape.flip_normals && !shape.to_world.mirrors()) {
      strategy_ = Strategy::cone;
      center_ = shape.to_world(Point3f(0, 0, 0));
      radius_ = std::sqrt(r2);
    }
  }
  power_ = kPi * float(area_) * radiance_.average().luminance();
}

Spectrum AreaLight::emitted(const Surface& surface, const Vector3f& w) const {
  return dot(surface.shading.n, w) > 0 ? radiance_(surface) : Spectrum();
}

ShapePoint AreaLight::sample_point(const Point2f& u) const {
  switch (strategy_) {
    case Strategy::triangles: {
      const auto pick = triangles_.sample(u.y);
      ShapePoint p = sample_triangle(shape_, pick.index, {u.x, pick.remapped});
      p.pdf = {float(1 / area_)};
      return p;
    }
    default:
      return sample_analytic(shape_, u);
  }
}

std::optional<LightSample> AreaLight::sample_direct(const Point3f& from, const Point2f& u) const {
  if (strategy_ == Strategy::parallelogram) return sample_parallelogram(from, u);
  if (strategy_ == Strategy::cone) return sample_cone(from, u);
  const ShapePoint p = sample_point(u);
  const Vector3f d = p.position - from;
  const float d2 = length_squared(d);
  if (!(d2 > 0)) return std::nullopt;
  const Vector3f wi = d * (1 / std::sqrt(d2));
  const float cosine = -dot(p.ng, wi);
  if (!(cosine > 0)) return std::nullopt;
  return toward(p, to_solid_angle(p.pdf, d2, cosine), wi);
}

std::optional<LightSample> AreaLight::sample_parallelogram(const Point3f& from,
                                                           const Point2f& u) const {
  const Point3f target = corner_ + (edge_u_ * u.x + edge_v_ * u.y);
  const Vector3f d = target - from;
  const float facing = -dot(normal_, d);
  if (!(facing > 0)) return std::nullopt;
  const float inv_distance = 1 / std::sqrt(length_squared(d));
  // cos θ / d², as a density per area of the parallelogram turned into one per solid angle
  const float solid_angle = facing * inv_distance * inv_distance * inv_distance * float(area_);
  Spectrum radiance = radiance_.constant;
  if (radiance_.texture) {
    Surface s;
    s.shape = &shape_;
    s.position = target;
    const TriangleMesh& m = *shape_.mesh;
    const auto& t = m.triangles[0];
    s.uv = m.uvs.empty() ? u
                         : m.uvs[t[0]] + (m.uvs[t[1]] - m.uvs[t[0]]) * u.x +
                               (m.uvs[t[2]] - m.uvs[t[1]]) * u.y;
    radiance = radiance_(s);
  }
  return LightSample{d * inv_distance, target, radiance * solid_angle, PdfW{1 / solid_angle}};
}

LightSample AreaLight::toward(const ShapePoint& p, PdfW pdf, const Vector3f& wi) const {
  Spectrum radiance = radiance_.constant;
  if (radiance_.texture) {
    Surface s;
    s.shape = &shape_;
    s.position = p.position;
    s.uv = p.uv;
    radiance = radiance_(s);
  }
  return {wi, p.position + Vector3f(p.ng) * p.offset, radiance / pdf.value, pdf};
}

namespace {

/// 1 − cos of the half angle under which a sphere appears, from the squared sine.
float one_minus_cosine(float sin2) {
  return sin2 < 1e-3f ? sin2 * (0.5f + 0.125f * sin2) : 1 - safe_sqrt(1 - sin2);
}

}  // namespace

std::optional<LightSample> AreaLight::sample_cone(const Point3f& from, const Point2f& u) const {
  const Vector3f axis = center_ - from;
  const float d2 = length_squared(axis), r2 = radius_ * radius_;
  // From within, the outward side cannot be seen.
  if (!(d2 > r2)) return std::nullopt;
  const float d = std::sqrt(d2);
  const float span = one_minus_cosine(r2 / d2);
  const Vector3f local = square_to_cone(u, span);
  const Vector3f wi = Frame(Normal3f(axis / d)).to_world(local);
  // The nearer intersection, from the triangle of the centre, `from` and the point.
  const float sin2 = sin2_theta(local);
  const float t = d * local.z - safe_sqrt(r2 - d2 * sin2);
  const Normal3f n(normalize((from + wi * t) - center_));
  ShapePoint p;
  p.position = center_ + Vector3f(n) * radius_;
  p.ng = n;
  p.offset = kOffsetScale * (max_abs(center_) + radius_);
  return toward(p, PdfW{1 / (2 * kPi * span)}, wi);
}

PdfW AreaLight::pdf_direct(const Point3f& from, const Surface& surface, const Vector3f& wi,
                           float d2) const {
  const float cosine = -dot(surface.ng, wi);
  if (!(cosine > 0)) return {};
  if (strategy_ == Strategy::cone) {
    const float c2 = length_squared(center_ - from), r2 = radius_ * radius_;
    return {c2 > r2 ? 1 / (2 * kPi * one_minus_cosine(r2 / c2)) : 0.0f};
  }
  if (strategy_ == Strategy::surface) {
    const Normal3f local = normalize(shape_.to_world.inverse(surface.ng));
    return to_solid_angle(pdf_analytic(shape_, local), d2, cosine);
  }
  return to_solid_angle(PdfA{float(1 / area_)}, d2, cosine);
}

}  // namespace duet
