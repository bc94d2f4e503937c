#include "mitsuba/texture_uses.h"

#include <utility>

namespace duet {

namespace {

/// Marks the textures that it meets.
class Marker {
 public:
  explicit Marker(const SceneDescription& scene) : scene_(scene), uses_(scene.textures.size()) {}
  std::vector<TextureUse> take() { return std::move(uses_); }

  template <class... Inputs>
  void mark(const Inputs&... inputs) {
    (input(inputs), ...);
  }

  void model(const DiffuseMaterial& m) { mark(m.reflectance); }
  void model(const ConductorMaterial& m) { mark(m.eta, m.k, m.specular_reflectance, m.roughness); }
  void model(const DielectricMaterial& m) {
    mark(m.eta, m.specular_reflectance, m.specular_transmittance, m.roughness);
  }
  void model(const ThinDielectricMaterial& m) {
    mark(m.specular_reflectance, m.specular_transmittance);
  }
  void model(const PlasticMaterial& m) {
    mark(m.diffuse_reflectance, m.specular_reflectance, m.roughness);
  }
  void model(const PrincipledMaterial& m) {
    mark(m.base_color, m.roughness, m.anisotropic, m.metallic, m.spec_trans, m.spec_tint, m.sheen,
         m.sheen_tint, m.flatness, m.clearcoat, m.clearcoat_gloss);
  }
  void model(const PrincipledThinMaterial& m) {
    mark(m.base_color, m.roughness, m.anisotropic, m.spec_trans, m.eta, m.spec_tint, m.sheen,
         m.sheen_tint, m.flatness, m.diff_trans);
  }
  void model(const PhongMaterial& m) {
    mark(m.diffuse_reflectance, m.specular_reflectance, m.exponent);
  }
  void model(const WardMaterial& m) {
    mark(m.diffuse_reflectance, m.specular_reflectance, m.alpha_u, m.alpha_v);
  }
  void model(const RoughDiffuseMaterial& m) { mark(m.reflectance, m.alpha); }
  void model(const DiffuseTransmitterMaterial& m) { mark(m.transmittance); }
  void model(const MixtureMaterial&) {}
  void model(const HairMaterial& m) {
    if (m.sigma_a) mark(*m.sigma_a);
  }
  void model(const MeasuredMaterial&) {}
  void model(const PolarizedPlasticMaterial& m) {
    mark(m.diffuse_reflectance, m.specular_reflectance, std::optional(m.interface));
  }
  void model(const FilterMaterial& m) { mark(m.transmittance); }
  void model(const CoatingMaterial& m) { mark(m.sigma_a, m.specular_reflectance, m.roughness); }
  void model(const ThinLayerMaterial& m) { mark(m.sigma_s, m.sigma_a); }
  void model(const TwoSidedMaterial&) {}
  void model(const MaskMaterial& m) { mark(m.opacity); }
  void model(const BlendMaterial& m) { mark(m.weight); }
  void model(const BumpMapMaterial& m) { mark(m.height); }
  void model(const NormalMapMaterial& m) { mark(m.normals); }
  void model(const NullMaterial&) {}

  void model(const PointLight&) {}
  void model(const SpotLight& l) {
    if (l.texture) mark(ColorInput(*l.texture));
  }
  void model(const ProjectorLight& l) { mark(l.irradiance); }
  void model(const DirectionalLight&) {}
  void model(const ConstantLight&) {}
  void model(const EnvironmentMapLight&) {}
  void model(const SkyLight&) {}
  void model(const CollimatedLight&) {}

 private:
  void input(const ColorInput& i) {
    if (const TextureId* id = std::get_if<TextureId>(&i)) texture(*id, &TextureUse::as_color);
  }
  void input(const FloatInput& i) {
    if (const TextureId* id = std::get_if<TextureId>(&i)) texture(*id, &TextureUse::as_number);
  }
  void input(const std::optional<Roughness>& r) {
    if (r) mark(r->alpha_u, r->alpha_v);
  }
  void texture(TextureId id, bool TextureUse::*use) {
    if (std::exchange(uses_[size_t(id)].*use, true)) return;
    const auto& model = scene_.textures[size_t(id)].model;
    if (const auto* scaled = std::get_if<ScaledTextureDescription>(&model))
      return texture(scaled->inner, use);
    if (const auto* lines = std::get_if<GridLinesTexture>(&model))
      return mark(lines->color0, lines->color1);
    const auto* board = std::get_if<CheckerboardTexture>(&model);
    if (!board) return;
    for (const ColorInput* color : {&board->color0, &board->color1})
      if (const TextureId* nested = std::get_if<TextureId>(color)) texture(*nested, use);
  }

  const SceneDescription& scene_;
  std::vector<TextureUse> uses_;
};

}  // namespace

std::vector<TextureUse> texture_uses(const SceneDescription& scene) {
  Marker marker(scene);
  const auto model = [&](const auto& m) { marker.model(m); };
  for (const MaterialDescription& m : scene.materials) std::visit(model, m.model);
  for (const LightDescription& l : scene.lights) std::visit(model, l.model);
  const auto shapes = [&](const std::vector<ShapeDescription>& list) {
    for (const ShapeDescription& s : list) {
      if (s.emission) marker.mark(s.emission->radiance);
      if (const auto* field = std::get_if<HeightFieldShape>(&s.geometry))
        marker.mark(ColorInput(field->heights));
    }
  };
  shapes(scene.shapes);
  for (const ShapeGroupDescription& g : scene.groups) shapes(g.shapes);
  for (const SensorDescription& s : scene.sensors) shapes(s.target_shape);
  return marker.take();
}

void settle_checkerboards(SceneDescription& scene) {
  const std::vector<TextureUse> uses = texture_uses(scene);
  for (size_t i = 0; i < uses.size(); ++i) {
    auto* board = std::get_if<CheckerboardTexture>(&scene.textures[i].model);
    if (!board || (uses[i].as_color && uses[i].as_number)) continue;
    if (uses[i].as_number && board->swap_values) std::swap(board->color0, board->color1);
    board->swap_values = false;
  }
}

}  // namespace duet
