// What a material is called in pbrt-v4, and what of it belongs to shapes: BSDFs that are made of
// others.
#include <algorithm>

#include "pbrt/scene_writer.h"

namespace duet::pbrt {

bool SceneWriter::write_both_ways(const BlendMaterial& m, const std::string& name,
                                  const Around& around) {
  const double* share = std::get_if<double>(&m.weight);
  const auto* first = d_.materials[size_t(m.first)].model.get_if<TwoSidedMaterial>();
  if (!share || !first || first->front != first->back) return false;
  const auto* diffuse = d_.materials[size_t(first->front)].model.get_if<DiffuseMaterial>();
  const auto* through = d_.materials[size_t(m.second)].model.get_if<DiffuseTransmitterMaterial>();
  if (!diffuse || !through) return false;
  // Each lobe is divided by its share in the description; of textures, halves are known.
  const auto part = [&](const ColorInput& lobe, double own) -> std::optional<ColorInput> {
    if (const Spectrum* c = std::get_if<Spectrum>(&lobe)) return *c * float(own);
    const auto& model = d_.textures[size_t(std::get<TextureId>(lobe))].model;
    const auto* scaled = std::get_if<ScaledTextureDescription>(&model);
    if (!scaled || scaled->scale != Spectrum(float(1 / own))) return std::nullopt;
    return scaled->inner;
  };
  const auto reflected = part(diffuse->reflectance, 1 - *share),
             transmitted = part(through->transmittance, *share);
  if (!reflected || !transmitted) return false;
  Statement s = named_material(name, "diffusetransmission");
  put(s, "reflectance", *reflected, true);
  put(s, "transmittance", *transmitted, true);
  end_material(s, around);
  return true;
}

void SceneWriter::write(const BlendMaterial& m, const std::string& name, const Around& around) {
  if (write_both_ways(m, name, around)) return;
  if (around.bumps || around.normals) lose("bumps on a blend of materials are missing");
  const std::string first = material(m.first, around.two_sided),
                    second = material(m.second, around.two_sided);
  Statement s = named_material(name, "mix");
  s.strings("materials", {first, second});
  put(s, "amount", m.weight);
  materials_text_ += s.text();
}

void SceneWriter::mixture(const MixtureMaterial& m, const std::string& name, const Around& around) {
  if (around.bumps || around.normals) lose("bumps on a blend of materials are missing");
  // Two by two; what the shares leave is black.
  const std::string black = unique_name("", "black", 0);
  materials_text_ += named_material(black, "diffuse").color("reflectance", Spectrum(0.0f)).text();
  std::string last = black;
  double left = 1;
  for (const auto& [weight, id] : m.parts) left -= weight;
  double sum = std::max(left, 0.0);
  for (size_t i = 0; i < m.parts.size(); ++i) {
    const auto& [weight, id] = m.parts[i];
    const bool ends = i + 1 == m.parts.size();
    const std::string both = ends ? name : unique_name("", name + "_part", i);
    const std::string part = material(id, around.two_sided);
    sum += weight;
    Statement s = named_material(both, "mix");
    s.strings("materials", {last, part}).number("amount", sum > 0 ? weight / sum : 0.5);
    materials_text_ += s.text();
    last = both;
  }
}

template <class... T>
bool SceneWriter::write_known(MaterialId id, const std::string& name, const Around& around) {
  const MaterialModel& model = d_.materials[size_t(id)].model;
  const auto one = [&]<class M>(const M* m) {
    if (m) write(*m, name, around);
    return m != nullptr;
  };
  return (one(model.get_if<T>()) || ...);
}

void SceneWriter::write_unknown(const MaterialModel& m, const std::string& name, Around around) {
  lose(fmt::format("the BSDF \"{}\" does not exist in pbrt: a diffuse one takes its place",
                   m.name()));
  DiffuseMaterial diffuse;
  m.for_each_field([&](const FieldFacts& facts, const FieldValue& value) {
    const auto* const* color = std::get_if<const ColorInput*>(&value);
    const bool is_base = facts.name() == "base_color" || facts.name() == "diffuse_reflectance" ||
                         facts.name() == "reflectance";
    if (color && is_base) diffuse.reflectance = **color;
  });
  around.two_sided = true;
  write(diffuse, name, around);
}

void SceneWriter::write_material(MaterialId id, const std::string& name, Around around) {
  const MaterialModel& model = d_.materials[size_t(id)].model;
  if (const auto* m = model.get_if<TwoSidedMaterial>()) {
    if (m->front != m->back) lose("the back of a surface has the BSDF of its front");
    around.two_sided = true;
    return write_material(m->front, name, around);
  }
  const bool is_bumpy = around.bumps || around.normals;
  if (is_bumpy && (model.is<BumpMapMaterial>() || model.is<NormalMapMaterial>())) {
    lose("a bump or normal map within another one is missing");
    return write_material(model.nested()[0], name, around);
  }
  if (const auto* m = model.get_if<BumpMapMaterial>()) {
    around.bumps = m;
    return write_material(m->nested, name, around);
  }
  if (const auto* m = model.get_if<NormalMapMaterial>()) {
    around.normals = m;
    return write_material(m->nested, name, around);
  }
  if (const auto* m = model.get_if<MaskMaterial>()) {
    lose("opacity within another BSDF is missing");
    return write_material(m->nested, name, around);
  }
  if (const auto* m = model.get_if<MixtureMaterial>()) return mixture(*m, name, around);
  if (model.is<NullMaterial>()) {
    materials_text_ += named_material(name, "interface").text();
    return;
  }
  if (write_known<DiffuseMaterial, DiffuseTransmitterMaterial, ConductorMaterial,
                  DielectricMaterial, ThinDielectricMaterial, PlasticMaterial, HairMaterial,
                  CoatedDiffuseMaterial, CoatedConductorMaterial, UberMaterial, SubstrateMaterial,
                  MeasuredMaterial, BlendMaterial>(id, name, around))
    return;
  write_unknown(model, name, around);
}

std::string SceneWriter::material(MaterialId id, bool two_sided) {
  const auto [entry, is_new] = materials_.try_emplace({id, two_sided});
  if (is_new) {
    const std::string name =
        unique_name(d_.materials[size_t(id)].label.text, "material", size_t(id));
    entry->second = name;
    write_material(id, name, {.two_sided = two_sided});
    return name;
  }
  return entry->second;
}

SceneWriter::Surface SceneWriter::surface(const ShapeDescription& s) {
  const MaterialModel& model = d_.materials[size_t(s.material)].model;
  // pbrt's opacity is the shape's.
  if (const auto* mask = model.get_if<MaskMaterial>())
    return {material(mask->nested), mask->opacity};
  if (const auto* both = model.get_if<TwoSidedMaterial>(); both && both->front == both->back)
    if (const auto* mask = d_.materials[size_t(both->front)].model.get_if<MaskMaterial>())
      return {material(mask->nested, true), mask->opacity};
  if (s.emission && model.is<NullMaterial>()) {
    // What emits must have a BSDF in pbrt; one that is nowhere opaque does not show.
    const std::string name = unique_name("", "unseen", 0);
    write(DiffuseMaterial{Spectrum(0.0f)}, name, {.two_sided = true});
    return {name, 0.0};
  }
  return {material(s.material), 1.0};
}

}  // namespace duet::pbrt
