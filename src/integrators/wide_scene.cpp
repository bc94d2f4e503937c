#include "integrators/wide_scene.h"

#include "materials/wrappers.h"

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
  bool always_smooth;            ///< see WideShape
  const ColorSlot* reflectance;  ///< which may depend on the point; null if there is none
};

std::optional<GlossySurface> as_glossy(const Material& material) {
  if (const auto plastic = as_rough_plastic(material))
    return GlossySurface{*plastic, plastic->two_sided,
                         plastic->plastic.microfacet.is_nearly_specular(), true, &plastic->base};
  if (const auto conductor = as_rough_conductor(material))
    return GlossySurface{*conductor, conductor->two_sided,
                         conductor->conductor.microfacet.is_nearly_specular(), false,
                         &conductor->reflectance};
  if (const auto plastic = as_plastic(material))
    return GlossySurface{*plastic, plastic->two_sided, false, false, &plastic->base};
  if (const auto principled = as_principled(material))
    return GlossySurface{*principled, principled->two_sided,
                         principled->model.facets.is_nearly_specular(), true,
                         &principled->base_color};
  if (const auto glass = as_rough_dielectric(material))
    return GlossySurface{*glass, false, glass->dielectric.microfacet.is_nearly_specular(), true,
                         nullptr};
  return std::nullopt;
}

bool is_small(const Texture* texture) {
  constexpr int64_t kSmall = 1 << 18;  // texels, in a cache near by
  const Point2i size = texture->resolution();
  return int64_t(size.x) * size.y <= kSmall;
}

}  // namespace

const WideScene::Textures* WideScene::large_textures(uint32_t material) {
  const auto [known, is_new] = textures_.try_emplace(material);
  Textures& list = known->second;
  if (is_new) {
    scene.materials[material]->list_textures(list);
    std::erase_if(list, is_small);
  }
  return list.empty() ? nullptr : &list;
}

void WideScene::set_reflectance(WideShape& w, const Shape& shape, const ColorSlot& slot) {
  w.reflectance = slot.constant;
  if (slot.is_constant()) return;
  w.textured = &slot;
  w.looks_up = true;
  w.prefetched = large_textures(shape.material);
}

template <class Surface>
int32_t WideScene::number_of(const Shape& shape, const Surface& surface,
                             std::vector<Surface>& surfaces) {
  const auto [known, is_new] = numbers_.try_emplace(shape.material, int32_t(surfaces.size()));
  if (is_new) surfaces.push_back(surface);
  return known->second;
}

bool WideScene::set_diffuse(WideShape& w, const Shape& shape, const Material& material) {
  const auto diffuse = as_diffuse(material);
  if (!diffuse) return false;
  w.model = WideModel::diffuse;
  w.two_sided = diffuse->two_sided;
  set_reflectance(w, shape, diffuse->reflectance);
  return true;
}

bool WideScene::set_glossy(WideShape& w, const Shape& shape, const Material& material,
                           WideUse use) {
  const auto surface = as_glossy(material);
  if (!surface || (use == WideUse::merging && surface->nearly_specular)) return false;
  w.model = WideModel::glossy;
  w.two_sided = surface->two_sided;
  w.always_smooth = surface->always_smooth;
  w.transmits = std::holds_alternative<RoughDielectricSurface>(surface->material);
  if (surface->reflectance) set_reflectance(w, shape, *surface->reflectance);
  w.number = number_of(shape, surface->material, glossy);
  return true;
}

bool WideScene::set_plain(WideShape& w, const Shape& shape, const Material& material, WideUse use) {
  if (!has_frame_of_normal(shape)) return false;
  if (set_diffuse(w, shape, material) || set_glossy(w, shape, material, use)) return true;
  const auto delta = as_specular(material);
  if (!delta) return false;
  w.model = WideModel::specular;
  w.number = number_of(shape, *delta, specular);
  return true;
}

bool WideScene::set_perturbed(WideShape& w, const Shape& shape, const Material& material) {
  const auto surface = as_perturbed(material);
  if (!surface) return false;
  const Material& nested = surface->map.nested();
  // In lanes the frame depends on the normal alone, and light does not pass.
  if (nested.needs().tangents || nested.transmits()) return false;
  if (!set_diffuse(w, shape, nested) && !set_glossy(w, shape, nested, WideUse::paths)) return false;
  w.perturbed = true;
  maps.resize(scene.shapes.size());
  maps[size_t(&shape - scene.shapes.data())].emplace(*surface);
  return true;
}

bool WideScene::set_masked(WideShape& w, const Shape& shape, const Material& material) {
  const Mask* const mask = as_mask(material);
  if (!mask) return false;
  const Material& nested = mask->nested();
  if (!set_plain(w, shape, nested, WideUse::paths) && !set_perturbed(w, shape, nested))
    return false;
  w.masked = w.looks_up = true;
  masks.resize(scene.shapes.size());
  masks[size_t(&shape - scene.shapes.data())] = mask;
  return true;
}

void WideScene::set_model(WideShape& w, const Shape& shape, WideUse use) {
  const Material& material = *scene.materials[shape.material];
  if (set_plain(w, shape, material, use)) return;
  w.prefetched = large_textures(shape.material);
  if (use == WideUse::paths && !set_perturbed(w, shape, material)) set_masked(w, shape, material);
}

WideScene::WideScene(const Scene& s, WideUse use) : scene(s), lights(s) {
  shapes.reserve(s.shapes.size());
  for (const Shape& shape : s.shapes) {
    WideShape& w = shapes.emplace_back();
    w.emits = shape.light != kNone;
    set_model(w, shape, use);
    if (shape.kind != ShapeKind::mesh) continue;
    w.mesh = WideMesh(shape);
    has_normals |= w.mesh.normals != nullptr;
  }
}

}  // namespace duet
