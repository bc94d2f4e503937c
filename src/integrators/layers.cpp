#include "integrators/layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace duet {

namespace {

const std::array<std::pair<const char*, LayerKind>, 24> kNames{{
    {"albedo", LayerKind::albedo},
    {"depth", LayerKind::depth},
    {"position", LayerKind::position},
    {"uv", LayerKind::uv},
    {"normal", LayerKind::normal},
    {"sh_normal", LayerKind::normal},
    {"geo_normal", LayerKind::geo_normal},
    {"dp_du", LayerKind::dp_du},
    {"dp_dv", LayerKind::dp_dv},
    {"duv_dx", LayerKind::duv_dx},
    {"duv_dy", LayerKind::duv_dy},
    {"dz_dx", LayerKind::dz_dx},
    {"dz_dy", LayerKind::dz_dy},
    {"prim_index", LayerKind::prim_index},
    {"shape", LayerKind::shape_index},
    {"shape_index", LayerKind::shape_index},
    {"moments", LayerKind::moments},
    {"variance", LayerKind::variance},
    {"sample_variance", LayerKind::sample_variance},
    {"relative_variance", LayerKind::relative_variance},
    {"samples", LayerKind::samples},
    {"denoise_albedo", LayerKind::denoise_albedo},
    {"denoise_normal", LayerKind::denoise_normal},
    {"denoise_split", LayerKind::denoise_split},
}};

std::vector<const char*> suffixes(LayerKind kind) {
  switch (kind) {
    case LayerKind::albedo:
    case LayerKind::denoise_albedo:
    case LayerKind::moments:
    case LayerKind::variance:
    case LayerKind::sample_variance:
    case LayerKind::relative_variance:
      return {"R", "G", "B"};
    case LayerKind::denoise_split:
      return {"R", "G", "B", "S"};
    case LayerKind::depth:
      return {"T"};
    case LayerKind::uv:
    case LayerKind::duv_dx:
    case LayerKind::duv_dy:
      return {"U", "V"};
    case LayerKind::dz_dx:
    case LayerKind::dz_dy:
      return {"Z"};
    case LayerKind::prim_index:
    case LayerKind::shape_index:
    case LayerKind::samples:
      return {"I"};
    default:
      return {"X", "Y", "Z"};
  }
}

template <class Triple>
void put(const Triple& t, std::span<float> out) {
  out[0] = t.x, out[1] = t.y, out[2] = t.z;
}

void put(const Spectrum& s, std::span<float> out) {
  out[0] = s.r, out[1] = s.g, out[2] = s.b;
}

/// Mitsuba knows no derivatives on linear curves and grids of distances. A surface has some even
/// there, for materials that cannot do without.
bool has_derivatives(const Shape& s) {
  return s.kind == ShapeKind::curves ? s.curves->kind != CurveKind::linear
                                     : s.kind != ShapeKind::sdf_grid;
}

/// From the surface's point to the one of its tangent plane where `next` meets it. Not finite if
/// there is none. Source: Igehy, "Tracing Ray Differentials", 1999.
Vector3f step_to(const Surface& s, const Ray& next) {
  const float distance = dot(s.ng, s.position - next.origin) / dot(s.ng, next.direction);
  return next.origin + next.direction * distance - s.position;
}

/// The change of uv on the way to `next`: what dp_du and dp_dv make up best of the step, by least
/// squares. Zero if there is no such point, or no coordinates.
Point2f uv_change(const Surface& s, const Ray& next) {
  const Vector3f step = step_to(s, next);
  const float uu = length_squared(s.dp_du), vv = length_squared(s.dp_dv),
              uv = dot(s.dp_du, s.dp_dv);
  const float determinant = uu * vv - uv * uv;
  const float along_u = dot(s.dp_du, step), along_v = dot(s.dp_dv, step);
  const Point2f change{(vv * along_u - uv * along_v) / determinant,
                       (uu * along_v - uv * along_u) / determinant};
  return std::isfinite(change.x) && std::isfinite(change.y) ? change : Point2f{0, 0};
}

/// The change of z on the way to `next`. Zero if there is no such point.
float z_change(const LayerPoint& point, const Ray& next) {
  const Vector3f step = step_to(point.surface, next);
  const float z = point.frame ? (*point.frame)(step).z : step.z;
  return std::isfinite(z) ? z : 0.0f;
}

Point3f told_position(const LayerPoint& point) {
  return point.frame ? (*point.frame)(point.surface.position) : point.surface.position;
}

Normal3f told_normal(const LayerPoint& point, const Normal3f& n) {
  if (!point.frame) return n;
  const Normal3f turned = normalize((*point.frame)(n));
  return dot(n, point.wo) < 0 ? -turned : turned;
}

}  // namespace

std::optional<LayerKind> find_layer(const std::string& name) {
  for (const auto& [text, kind] : kNames)
    if (name == text) return kind;
  return std::nullopt;
}

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n;
    for (const auto& [text, kind] : kNames) n.emplace_back(text);
    return n;
  }();
  return names;
}

std::vector<std::string> layer_channels(const Layer& layer) {
  std::vector<std::string> channels;
  for (const char* s : suffixes(layer.kind)) channels.push_back(layer.name + "." + s);
  return channels;
}

SurfaceNeeds layer_needs(LayerKind kind) {
  const bool tangents = kind == LayerKind::dp_du || kind == LayerKind::dp_dv ||
                        kind == LayerKind::duv_dx || kind == LayerKind::duv_dy;
  return {kind == LayerKind::uv, tangents};
}

bool layer_needs_next_rays(LayerKind kind) {
  return kind == LayerKind::duv_dx || kind == LayerKind::duv_dy || kind == LayerKind::dz_dx ||
         kind == LayerKind::dz_dy;
}

bool layer_needs_image(LayerKind kind) {
  return kind == LayerKind::moments || kind == LayerKind::variance ||
         kind == LayerKind::sample_variance || kind == LayerKind::relative_variance ||
         kind == LayerKind::denoise_split;
}

bool layer_follows_specular(LayerKind kind) {
  return kind == LayerKind::denoise_albedo || kind == LayerKind::denoise_normal;
}

void evaluate_split(uint32_t sample, const Spectrum& radiance, std::span<float> out) {
  // Of the samples from a power of two to the next the first half has one sign, the second the
  // other: the highest bit but one, and of the first two samples the lowest.
  const uint32_t half = std::max(std::bit_floor(sample) >> 1, 1u);
  const float sign = (sample & half) != 0 ? -1.0f : 1.0f;
  put(radiance * sign, out);
  out[3] = sign;
}

void evaluate_layer(LayerKind kind, const Scene& scene, const LayerPoint& point,
                    std::span<float> out) {
  const Surface& s = point.surface;
  switch (kind) {
    case LayerKind::albedo:
      put(scene.materials[s.shape->material]->albedo(s, point.wo), out);
      break;
    case LayerKind::denoise_albedo:
      put(point.specular->albedo, out);
      break;
    case LayerKind::denoise_normal:
      put(point.specular->normal, out);
      break;
    case LayerKind::depth:
      out[0] = point.hit.t;
      break;
    case LayerKind::position:
      put(told_position(point), out);
      break;
    case LayerKind::uv:
      out[0] = s.uv.x, out[1] = s.uv.y;
      break;
    case LayerKind::normal:
      put(told_normal(point, s.shading.n), out);
      break;
    case LayerKind::geo_normal:
      put(told_normal(point, s.ng), out);
      break;
    case LayerKind::dp_du:
    case LayerKind::dp_dv:
      if (has_derivatives(*s.shape)) put(kind == LayerKind::dp_du ? s.dp_du : s.dp_dv, out);
      break;
    case LayerKind::duv_dx:
    case LayerKind::duv_dy:
      if (point.next && has_derivatives(*s.shape)) {
        const NextRays& next = *point.next;
        const Point2f c = uv_change(s, kind == LayerKind::duv_dx ? next.right : next.below);
        out[0] = c.x, out[1] = c.y;
      }
      break;
    case LayerKind::dz_dx:
    case LayerKind::dz_dy:
      if (point.next)
        out[0] = z_change(point, kind == LayerKind::dz_dx ? point.next->right : point.next->below);
      break;
    case LayerKind::prim_index:
      out[0] = float(point.hit.primitive);
      break;
    case LayerKind::shape_index:
      out[0] = float(point.hit.shape);
      break;
    case LayerKind::moments:
    case LayerKind::variance:
    case LayerKind::sample_variance:
    case LayerKind::relative_variance:
    case LayerKind::samples:
    case LayerKind::denoise_split:
      break;
  }
}

}  // namespace duet
