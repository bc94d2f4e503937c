#include "integrators/wide_scene.h"

namespace duet {

namespace {

/// Whether the shading frame at a point depends on the normal alone: that is the one that batches
/// have. Others are turned around it, which makes other paths of the same random numbers.
bool has_frame_of_normal(const Shape& shape) {
  if (shape.needs.tangents || shape.kind == ShapeKind::curves) return false;
  return shape.kind == ShapeKind::mesh || !shape.needs.uv;
}

struct GlossySurface {
  WideGlossyMaterial material;
  bool two_sided, nearly_specular;
  const ColorSlot* reflectance;  ///< which may depend on the point; null if there is none
};

std::optional<GlossySurface> as_glossy(const Material& material) {
  if (const auto plastic = as_rough_plastic(material))
    return GlossySurface{*plastic, plastic->two_sided,
                         plastic->plastic.microfacet.is_nearly_specular(), &plastic->base};
  if (const auto conductor = as_rough_conductor(material))
    return GlossySurface{*conductor, conductor->two_sided,
                         conductor->conductor.microfacet.is_nearly_specular(),
                         &conductor->reflectance};
  if (const auto plastic = as_plastic(material))
    return GlossySurface{*plastic, plastic->two_sided, false, &plastic->base};
  if (const auto glass = as_rough_dielectric(material))
    return GlossySurface{*glass, false, glass->dielectric.microfacet.is_nearly_specular(), nullptr};
  return std::nullopt;
}

/// The texture if the processor is likely to wait for its texels, or null.
const Texture* if_large(const Texture* texture) {
  constexpr int64_t kSmall = 1 << 18;  // texels, in a cache near by
  if (!texture) return nullptr;
  const Point2i size = texture->resolution();
  return int64_t(size.x) * size.y > kSmall ? texture : nullptr;
}

}  // namespace

void WideScene::set_model(WideShape& w, const Shape& shape, bool merges) {
  const Material& material = *scene.materials[shape.material];
  const auto set_reflectance = [&](const ColorSlot& slot) {
    w.reflectance = slot.constant;
    if (slot.is_constant()) return;
    w.textured = &slot;
    w.prefetched = if_large(slot.texture);
  };
  const auto number_of = [this](uint32_t name, const auto& surface, auto& surfaces) {
    const auto [known, is_new] = numbers_.try_emplace(name, int32_t(surfaces.size()));
    if (is_new) surfaces.push_back(surface);
    return known->second;
  };
  const bool by_normal = has_frame_of_normal(shape);
  if (const auto diffuse = by_normal ? as_diffuse(material) : std::nullopt) {
    w.model = WideModel::diffuse;
    w.two_sided = diffuse->two_sided;
    set_reflectance(diffuse->reflectance);
  } else if (const auto surface = by_normal ? as_glossy(material) : std::nullopt;
             surface && !(merges && surface->nearly_specular)) {
    w.model = WideModel::glossy;
    w.two_sided = surface->two_sided;
    w.transmits = std::holds_alternative<RoughDielectricSurface>(surface->material);
    if (surface->reflectance) set_reflectance(*surface->reflectance);
    w.number = number_of(shape.material, surface->material, glossy);
  } else if (const auto delta = by_normal ? as_specular(material) : std::nullopt) {
    w.model = WideModel::specular;
    w.number = number_of(shape.material, *delta, specular);
  } else {
    w.prefetched = if_large(material.main_texture());
  }
}

WideScene::WideScene(const Scene& s, bool merges) : scene(s), lights(s) {
  shapes.reserve(s.shapes.size());
  for (const Shape& shape : s.shapes) {
    WideShape& w = shapes.emplace_back();
    w.emits = shape.light != kNone;
    set_model(w, shape, merges);
    if (shape.kind != ShapeKind::mesh) continue;
    w.mesh = WideMesh(shape);
    has_normals |= w.mesh.normals != nullptr;
  }
}

}  // namespace duet
