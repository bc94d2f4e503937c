// Builds materials from their descriptions.
#include "materials/coating.h"
#include "materials/special_materials.h"
#include "materials/wrappers.h"
#include "scene/builder.h"

namespace duet {

const Material* SceneBuilder::material(MaterialId id) {
  const size_t index = size_t(id);
  return once(materials_[index], [&]() -> const Material* {
    const MaterialDescription& d = description_.materials[index];
    auto made = std::visit([&](const auto& m) { return make(m, d.where); }, d.model);
    if (!made) return nullptr;
    if (const int n = made->component_count(); n > Bsdf::kMaxComponents) {
      diagnostics_.error(d.where, "{} BSDFs are mixed here; at most {} can be", n,
                         Bsdf::kMaxComponents);
      return nullptr;
    }
    if (made->cover_count() > kMaxCovers) {
      diagnostics_.error(d.where,
                         "{} bump maps, normal maps and coatings lie over each other here; "
                         "at most {} can",
                         made->cover_count(), kMaxCovers);
      return nullptr;
    }
    materials_[index].index = uint32_t(scene_->materials.size());
    scene_->materials.push_back(std::move(made));
    return scene_->materials.back().get();
  });
}

RoughnessOptions SceneBuilder::roughness(const Roughness& r) {
  const FloatSlot alpha_u = slot(r.alpha_u);
  return {r.distribution, alpha_u, slot(r.alpha_v), r.sample_visible};
}

std::unique_ptr<Material> SceneBuilder::make(const DiffuseMaterial& m, const SourceLocation&) {
  return std::make_unique<Diffuse>(slot(m.reflectance));
}

std::unique_ptr<Material> SceneBuilder::make(const ConductorMaterial& m, const SourceLocation&) {
  const ConductorOptions o{slot(m.eta), slot(m.k), slot(m.specular_reflectance)};
  if (m.roughness) return std::make_unique<RoughConductor>(o, roughness(*m.roughness));
  return std::make_unique<Conductor>(o);
}

std::unique_ptr<Material> SceneBuilder::make(const DielectricMaterial& m, const SourceLocation&) {
  const DielectricOptions o{slot(m.eta), slot(m.specular_reflectance),
                            slot(m.specular_transmittance)};
  if (m.roughness) return std::make_unique<RoughDielectric>(o, roughness(*m.roughness));
  return std::make_unique<Dielectric>(o);
}

std::unique_ptr<Material> SceneBuilder::make(const ThinDielectricMaterial& m,
                                             const SourceLocation&) {
  return std::make_unique<ThinDielectric>(DielectricOptions{
      {float(m.eta)}, slot(m.specular_reflectance), slot(m.specular_transmittance)});
}

std::unique_ptr<Material> SceneBuilder::make(const PlasticMaterial& m, const SourceLocation&) {
  const PlasticOptions o{float(m.eta), slot(m.diffuse_reflectance), slot(m.specular_reflectance),
                         m.nonlinear};
  if (m.roughness) return std::make_unique<RoughPlastic>(o, roughness(*m.roughness));
  return std::make_unique<Plastic>(o);
}

std::unique_ptr<Material> SceneBuilder::make(const PhongMaterial& m, const SourceLocation&) {
  return std::make_unique<Phong>(
      PhongOptions{slot(m.diffuse_reflectance), slot(m.specular_reflectance), slot(m.exponent)});
}

std::unique_ptr<Material> SceneBuilder::make(const WardMaterial& m, const SourceLocation&) {
  return std::make_unique<Ward>(WardOptions{slot(m.diffuse_reflectance),
                                            slot(m.specular_reflectance), slot(m.alpha_u),
                                            slot(m.alpha_v), m.variant});
}

std::unique_ptr<Material> SceneBuilder::make(const RoughDiffuseMaterial& m, const SourceLocation&) {
  return std::make_unique<RoughDiffuse>(slot(m.reflectance), slot(m.alpha), m.use_fast_approx);
}

std::unique_ptr<Material> SceneBuilder::make(const DiffuseTransmitterMaterial& m,
                                             const SourceLocation&) {
  return std::make_unique<DiffuseTransmitter>(slot(m.transmittance));
}

std::unique_ptr<Material> SceneBuilder::make(const HairMaterial& m, const SourceLocation&) {
  HairOptions o;
  o.longitudinal_roughness = float(m.longitudinal_roughness);
  o.azimuthal_roughness = float(m.azimuthal_roughness);
  o.scale_tilt = float(m.scale_tilt) * (kPi / 180);
  o.eta = float(m.eta);
  o.absorption = m.sigma_a ? slot(*m.sigma_a)
                           : ColorSlot{hair_absorption(float(m.eumelanin), float(m.pheomelanin))};
  if (m.sigma_a) o.absorption_scale = float(m.scale);
  return std::make_unique<HairFibre>(o);
}

std::unique_ptr<Material> SceneBuilder::make(const MeasuredMaterial& m, const SourceLocation&) {
  return std::make_unique<Measured>(m.table);
}

std::unique_ptr<Material> SceneBuilder::make(const PolarizedPlasticMaterial& m,
                                             const SourceLocation&) {
  const PlasticOptions o{float(m.eta), slot(m.diffuse_reflectance), slot(m.specular_reflectance)};
  return std::make_unique<PolarizedPlastic>(o, roughness(m.interface));
}

std::unique_ptr<Material> SceneBuilder::make(const FilterMaterial& m, const SourceLocation&) {
  return std::make_unique<Filter>(slot(m.transmittance),
                                  m.kind == FilterKindOfLight::retarder ? 1.0f : 0.5f,
                                  m.kind == FilterKindOfLight::circular);
}

std::unique_ptr<Material> SceneBuilder::make(const CoatingMaterial& m, const SourceLocation&) {
  CoatingOptions o{float(m.eta), float(m.thickness), slot(m.sigma_a), slot(m.specular_reflectance),
                   std::nullopt};
  if (m.roughness) o.roughness = roughness(*m.roughness);
  const Material* nested = material(m.nested);
  return nested ? std::make_unique<Coating>(o, *nested) : nullptr;
}

std::unique_ptr<Material> SceneBuilder::make(const ThinLayerMaterial& m, const SourceLocation&) {
  return std::make_unique<ThinLayer>(
      ThinLayerOptions{slot(m.sigma_s), slot(m.sigma_a), float(m.thickness), float(m.g)});
}

template <class Options, class Description>
Options SceneBuilder::principled_options(const Description& m) {
  Options o;
  o.base_color = slot(m.base_color);
  o.roughness = slot(m.roughness);
  o.anisotropic = slot(m.anisotropic);
  o.spec_trans = slot(m.spec_trans);
  o.spec_tint = slot(m.spec_tint);
  o.sheen = slot(m.sheen);
  o.sheen_tint = slot(m.sheen_tint);
  o.flatness = slot(m.flatness);
  o.diffuse_reflectance_sampling_rate = float(m.diffuse_reflectance_sampling_rate);
  return o;
}

std::unique_ptr<Material> SceneBuilder::make(const PrincipledMaterial& m, const SourceLocation&) {
  auto o = principled_options<PrincipledOptions>(m);
  o.metallic = slot(m.metallic);
  o.eta = m.specular ? principled_eta(float(*m.specular), is_used(o.spec_trans)) : float(m.eta);
  o.clearcoat = slot(m.clearcoat);
  o.clearcoat_gloss = slot(m.clearcoat_gloss);
  o.main_specular_sampling_rate = float(m.main_specular_sampling_rate);
  o.clearcoat_sampling_rate = float(m.clearcoat_sampling_rate);
  return std::make_unique<Principled>(o);
}

std::unique_ptr<Material> SceneBuilder::make(const PrincipledThinMaterial& m,
                                             const SourceLocation&) {
  auto o = principled_options<PrincipledThinOptions>(m);
  o.eta = slot(m.eta);
  o.diff_trans = slot(m.diff_trans);
  o.spec_reflectance_sampling_rate = float(m.spec_reflectance_sampling_rate);
  o.spec_transmittance_sampling_rate = float(m.spec_transmittance_sampling_rate);
  o.diffuse_transmittance_sampling_rate = float(m.diffuse_transmittance_sampling_rate);
  return std::make_unique<PrincipledThin>(o);
}

std::unique_ptr<Material> SceneBuilder::make(const TwoSidedMaterial& m,
                                             const SourceLocation& where) {
  const Material *front = material(m.front), *back = material(m.back);
  if (!front || !back) return nullptr;
  if (front->transmits() || back->transmits()) {
    diagnostics_.error(where, "a BSDF that lets light through cannot be in a \"twosided\" one");
    return nullptr;
  }
  return std::make_unique<TwoSided>(*front, *back);
}

std::unique_ptr<Material> SceneBuilder::make(const MaskMaterial& m, const SourceLocation&) {
  const FloatSlot opacity = slot(m.opacity);
  const Material* nested = material(m.nested);
  return nested ? std::make_unique<Mask>(opacity, *nested) : nullptr;
}

std::unique_ptr<Material> SceneBuilder::make(const BlendMaterial& m, const SourceLocation&) {
  const FloatSlot weight = slot(m.weight);
  const Material *first = material(m.first), *second = material(m.second);
  return first && second ? std::make_unique<Blend>(weight, *first, *second) : nullptr;
}

std::unique_ptr<Material> SceneBuilder::make(const MixtureMaterial& m, const SourceLocation&) {
  std::vector<Mixture::Part> parts;
  for (const auto& [weight, id] : m.parts) {
    const Material* part = material(id);
    if (!part) return nullptr;
    parts.push_back({float(weight), part});
  }
  return std::make_unique<Mixture>(std::move(parts));
}

const Material* SceneBuilder::perturbed(MaterialId id, const SourceLocation& where) {
  const Material* nested = material(id);
  if (!nested || !nested->perturbs()) return nested;
  diagnostics_.error(where, "a bump or normal map within another one is not supported");
  return nullptr;
}

std::unique_ptr<Material> SceneBuilder::make(const BumpMapMaterial& m,
                                             const SourceLocation& where) {
  const FloatSlot height = slot(m.height);
  const Material* nested = perturbed(m.nested, where);
  if (!nested) return nullptr;
  return std::make_unique<BumpMap>(
      height, float(m.scale), PerturbationOptions{m.flip_invalid_normals, m.use_shadowing_function},
      *nested);
}

std::unique_ptr<Material> SceneBuilder::make(const NormalMapMaterial& m,
                                             const SourceLocation& where) {
  const ColorSlot normals = slot(m.normals);
  const Material* nested = perturbed(m.nested, where);
  if (!nested) return nullptr;
  return std::make_unique<NormalMap>(
      normals, PerturbationOptions{m.flip_invalid_normals, m.use_shadowing_function}, *nested);
}

std::unique_ptr<Material> SceneBuilder::make(const NullMaterial&, const SourceLocation&) {
  return std::make_unique<Null>();
}

}  // namespace duet
