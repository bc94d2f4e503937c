#include "materials/wrappers.h"

#include <algorithm>

#include "geometry/curvature.h"

namespace duet {

TwoSided::TwoSided(const Material& front, const Material& back) : front_(front), back_(back) {
  if (&front == &back && front.constant()) set_constant_two_sided(*front.constant());
}

int TwoSided::component_count() const {
  return std::max(front_.component_count(), back_.component_count());
}

Spectrum TwoSided::local_albedo(const Surface& surface, const Vector3f& wo) const {
  return wo.z >= 0 ? front_.local_albedo(surface, wo)
                   : back_.local_albedo(surface, {wo.x, wo.y, -wo.z});
}

void TwoSided::add_components(const Surface& surface, BsdfBuilder& builder) const {
  if (builder.wo().z >= 0) {
    front_.bind(surface, builder);
  } else {
    builder.flipped([&](BsdfBuilder& b) { back_.bind(surface, b); });
  }
}

SurfaceNeeds Mask::needs() const {
  return nested_.needs() | SurfaceNeeds{.uv = opacity_.needs_uv()};
}

bool Mask::transmits() const {
  return nested_.transmits() || !(opacity_.is_constant() && opacity_.constant >= 1);
}

void Mask::add_components(const Surface& surface, BsdfBuilder& builder) const {
  const float opaque = share(surface);
  builder.with_share(opaque, [&](BsdfBuilder& b) { nested_.bind(surface, b); });
  builder.with_share(1 - opaque, [&](BsdfBuilder& b) { b.add(NullModel{}); });
}

SurfaceNeeds Blend::needs() const {
  return first_.needs() | second_.needs() | SurfaceNeeds{.uv = weight_.needs_uv()};
}

Spectrum Blend::local_albedo(const Surface& surface, const Vector3f& wo) const {
  return lerp(first_.local_albedo(surface, wo), second_.local_albedo(surface, wo),
              std::clamp(weight_(surface), 0.0f, 1.0f));
}

void Blend::add_components(const Surface& surface, BsdfBuilder& builder) const {
  const float weight = std::clamp(weight_(surface), 0.0f, 1.0f);
  builder.with_share(1 - weight, [&](BsdfBuilder& b) { first_.bind(surface, b); });
  builder.with_share(weight, [&](BsdfBuilder& b) { second_.bind(surface, b); });
}

SurfaceNeeds Mixture::needs() const {
  SurfaceNeeds needs;
  for (const Part& p : parts_) needs = needs | p.material->needs();
  return needs;
}

int Mixture::component_count() const {
  int count = 0;
  for (const Part& p : parts_) count += p.material->component_count();
  return count;
}

bool Mixture::transmits() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& p) { return p.material->transmits(); });
}

bool Mixture::perturbs() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& p) { return p.material->perturbs(); });
}

void Mixture::list_textures(std::vector<const Texture*>& out) const {
  for (const Part& p : parts_) p.material->list_textures(out);
}

CoverCount Mixture::cover_count() const {
  CoverCount sum;
  for (const Part& p : parts_) sum = both(sum, p.material->cover_count());
  return sum;
}

Spectrum Mixture::local_albedo(const Surface& surface, const Vector3f& wo) const {
  Spectrum sum;
  for (const Part& p : parts_) sum += p.material->local_albedo(surface, wo) * p.weight;
  return sum;
}

void Mixture::add_components(const Surface& surface, BsdfBuilder& builder) const {
  for (const Part& p : parts_)
    builder.with_share(p.weight, [&](BsdfBuilder& b) { p.material->bind(surface, b); });
}

Normal3f Perturbed::unit_normal(const Surface& surface) const {
  const Normal3f n = normal(surface);
  // Where a map says nothing the surface is left as it is.
  const float scale = max_abs(n);
  return scale > 0 && is_finite(n) ? normalize(n * (1 / scale)) : Normal3f(0, 0, 1);
}

namespace {

/// The surface with another shading frame, given in the present one.
Surface turned(const Surface& s, const Frame& local) {
  Surface out = s;
  out.shading = {s.shading.to_world(local.s), s.shading.to_world(local.t),
                 Normal3f(s.shading.to_world(Vector3f(local.n)))};
  return out;
}

}  // namespace

void Perturbed::add_components(const Surface& surface, BsdfBuilder& builder) const {
  const Normal3f n = unit_normal(surface);
  builder.tilted(n, options_, [&](BsdfBuilder& b) {
    if (nested_perturbs_) [[unlikely]]
      nested_.bind(turned(surface, Tilt::frame_around(n)), b);
    else
      nested_.bind(surface, b);
  });
}

SurfaceNeeds BumpMap::needs() const {
  return nested_.needs() | SurfaceNeeds{.uv = height_.needs_uv(), .tangents = true};
}

namespace {

/// Replaces the tangents by those that pbrt has on meshes with normals, which are kept for
/// rendering only if they are not flat.
void set_bump_tangents(Surface& s) {
  const TriangleMesh* mesh = s.shape->mesh.get();
  if (!mesh || mesh->bump_tangents == BumpTangents::derivatives) return;
  const Vector3f n(s.shading.n);
  Vector3f u = s.dp_du - n * dot(n, s.dp_du);
  if (mesh->bump_tangents == BumpTangents::unit_backwards) u = -normalize(u);
  s.dp_du = u;
  s.dp_dv = cross(n, u);
}

/// Across a surface displaced by heights with the derivatives `slope`, which move its points by
/// `turned` besides; in the shading frame.
Normal3f displaced_normal(const Surface& s, const Point2f& slope, const NormalDerivatives& turned) {
  const Vector3f n(s.shading.n);
  const Vector3f du = s.dp_du + n * (slope.x - dot(n, s.dp_du)) + turned.du;
  const Vector3f dv = s.dp_dv + n * (slope.y - dot(n, s.dp_dv)) + turned.dv;
  const Vector3f up = cross(du, dv);
  return Normal3f(s.shading.to_local(dot(s.ng, up) < 0 ? -up : up));
}

}  // namespace

Normal3f BumpMap::normal(const Surface& s) const {
  if (!follows_curvature_) return displaced_normal(s, height_.gradient(s) * scale_, {});
  const float height = height_(s) * scale_;
  const NormalDerivatives turning = normal_derivatives(s);
  Surface base = s;
  set_bump_tangents(base);
  return displaced_normal(base, height_.gradient(base) * scale_,
                          {turning.du * height, turning.dv * height});
}

SurfaceNeeds NormalMap::needs() const {
  return nested_.needs() | SurfaceNeeds{.uv = normals_.needs_uv(), .tangents = true};
}

Normal3f NormalMap::normal(const Surface& s) const {
  const Spectrum c = normals_(s);
  return {2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1};
}

}  // namespace duet
