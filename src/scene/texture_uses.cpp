#include "scene/texture_uses.h"

#include <set>
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

  template <class T>
  void model(const T& plugin) {
    for_each_field(plugin, [&](const FieldFacts&, const auto& value) { input(value); });
  }

 private:
  void input(const ColorInput& i) {
    if (const TextureId* id = std::get_if<TextureId>(&i)) texture(*id, &TextureUse::as_color);
  }
  void input(const FloatInput& i) {
    if (const TextureId* id = std::get_if<TextureId>(&i)) texture(*id, &TextureUse::as_number);
  }
  void input(TextureId id) { texture(id, &TextureUse::as_color); }
  void input(const Roughness& r) { mark(r.alpha_u, r.alpha_v); }
  template <class T>
  void input(const std::optional<T>& value) {
    if (value) input(*value);
  }
  template <class T>
  void input(const T&) {}  // other values name no textures
  void texture(TextureId id, bool TextureUse::*use) {
    if (std::exchange(uses_[size_t(id)].*use, true)) return;
    std::visit([&](const auto& model) { nested(model, use); }, scene_.textures[size_t(id)].model);
  }
  /// What is nested in a texture is asked for the same, unless the texture makes numbers of
  /// colours.
  template <class T>
  void nested(const T& model, bool TextureUse::*use) {
    if constexpr (requires { T::kAsksForColors; }) use = &TextureUse::as_color;
    for_each_field(model, [&](const FieldFacts&, const auto& value) {
      using M = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<M, TextureId>)
        texture(value, use);
      else if constexpr (std::is_same_v<M, ColorInput>) {
        if (const TextureId* inner = std::get_if<TextureId>(&value)) texture(*inner, use);
      } else if constexpr (std::is_same_v<M, FloatInput>)
        input(value);
    });
  }

  const SceneDescription& scene_;
  std::vector<TextureUse> uses_;
};

void add_material(const SceneDescription& scene, MaterialId id, std::set<MaterialId>& used) {
  if (!used.insert(id).second) return;
  for (const MaterialId nested : scene.materials[size_t(id)].model.nested())
    add_material(scene, nested, used);
}

/// With those of its materials for which `counts` is true.
template <class Counts>
std::vector<TextureUse> uses(const SceneDescription& scene, const Counts& counts) {
  Marker marker(scene);
  const auto model = [&](const auto& m) { marker.model(m); };
  for (size_t i = 0; i < scene.materials.size(); ++i)
    if (counts(MaterialId(i))) marker.model(scene.materials[i].model);
  for (const LightDescription& l : scene.lights) std::visit(model, l.model);
  const auto shape = [&](const ShapeDescription& s) {
    if (s.emission) marker.mark(s.emission->radiance);
    std::visit(model, s.geometry);
  };
  for_each_shape(scene, shape);
  for (const SensorDescription& s : scene.sensors)
    for (const ShapeDescription& target : s.target_shape) shape(target);
  return marker.take();
}

}  // namespace

std::vector<TextureUse> texture_uses(const SceneDescription& scene) {
  return uses(scene, [](MaterialId) { return true; });
}

std::vector<TextureUse> texture_uses_of_shapes(const SceneDescription& scene) {
  std::set<MaterialId> used;
  for_each_shape(scene, [&](const ShapeDescription& s) {
    if (!std::holds_alternative<InstanceShape>(s.geometry)) add_material(scene, s.material, used);
  });
  return uses(scene, [&](MaterialId id) { return used.contains(id); });
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
