#include "materials/plain_diffuse.h"

#include "materials/materials.h"
#include "materials/principled_materials.h"
#include "materials/wrappers.h"

namespace duet {

namespace {

/// A material without the wrapper that makes it that of both sides.
struct Unwrapped {
  const Material* material;  ///< null if the sides differ
  bool two_sided;
};

Unwrapped unwrapped(const Material& material) {
  const auto* two_sided = dynamic_cast<const TwoSided*>(&material);
  return two_sided ? Unwrapped{two_sided->of_both_sides(), true} : Unwrapped{&material, false};
}

bool has_visible_facets(const Microfacet& m) {
  return m.is_visible_ggx() || m.is_visible_beckmann();
}

}  // namespace

std::optional<PerturbedSurface> as_perturbed(const Material& material) {
  const Unwrapped bare = unwrapped(material);
  const auto* map = dynamic_cast<const Perturbed*>(bare.material);
  if (!map) return std::nullopt;
  return PerturbedSurface{*map, bare.two_sided};
}

const Mask* as_mask(const Material& material) {
  return dynamic_cast<const Mask*>(&material);
}

std::optional<DiffuseSurface> as_diffuse(const Material& material) {
  const Unwrapped bare = unwrapped(material);
  const auto* diffuse = dynamic_cast<const Diffuse*>(bare.material);
  if (!diffuse) return std::nullopt;
  return DiffuseSurface{diffuse->reflectance(), bare.two_sided};
}

std::optional<RoughPlasticSurface> as_rough_plastic(const Material& material) {
  const Unwrapped bare = unwrapped(material);
  const auto* plastic = dynamic_cast<const RoughPlastic*>(bare.material);
  const auto uniform = plastic ? plastic->uniform() : std::nullopt;
  if (!uniform || !has_visible_facets(uniform->microfacet)) return std::nullopt;
  if (!(uniform->specular_reflectance.mean() > 0) || uniform->eta == 1) return std::nullopt;
  return RoughPlasticSurface{plastic->base(), *uniform, bare.two_sided};
}

std::optional<PlasticSurface> as_plastic(const Material& material) {
  const Unwrapped bare = unwrapped(material);
  const auto* plastic = dynamic_cast<const Plastic*>(bare.material);
  const auto uniform = plastic ? plastic->uniform() : std::nullopt;
  if (!uniform || !(uniform->specular_reflectance.mean() > 0)) return std::nullopt;
  return PlasticSurface{plastic->base(), *uniform, bare.two_sided};
}

std::optional<RoughConductorSurface> as_rough_conductor(const Material& material) {
  const Unwrapped bare = unwrapped(material);
  const auto* conductor = dynamic_cast<const RoughConductor*>(bare.material);
  const auto uniform = conductor ? conductor->uniform() : std::nullopt;
  if (!uniform || !has_visible_facets(uniform->microfacet)) return std::nullopt;
  return RoughConductorSurface{conductor->specular_reflectance(), *uniform, bare.two_sided};
}

std::optional<PrincipledSurface> as_principled(const Material& material) {
  const Unwrapped bare = unwrapped(material);
  const auto* principled = dynamic_cast<const Principled*>(bare.material);
  const auto model = principled ? principled->uniform_reflection() : std::nullopt;
  if (!model) return std::nullopt;
  return PrincipledSurface{principled->base_color(), *model, bare.two_sided};
}

std::optional<RoughDielectricSurface> as_rough_dielectric(const Material& material) {
  const ConstantMaterial* const constant = material.constant();
  if (!constant || constant->component.kind != ModelKind::rough_dielectric) return std::nullopt;
  const RoughDielectricModel& dielectric = constant->component.model.rough_dielectric;
  if (!has_visible_facets(dielectric.microfacet) || dielectric.eta == 1) return std::nullopt;
  return RoughDielectricSurface{dielectric};
}

std::optional<SpecularSurface> as_specular(const Material& material) {
  const ConstantMaterial* const constant = material.constant();
  if (!constant) return std::nullopt;
  const ModelUnion& model = constant->component.model;
  switch (constant->component.kind) {
    case ModelKind::dielectric:
      return SpecularSurface{model.dielectric, constant->two_sided};
    case ModelKind::thin_dielectric:
      return SpecularSurface{model.thin_dielectric, constant->two_sided};
    case ModelKind::conductor:
      return SpecularSurface{model.conductor, constant->two_sided};
    default:
      return std::nullopt;
  }
}

}  // namespace duet
