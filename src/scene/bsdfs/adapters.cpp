#include "scene/bsdfs/adapters.h"

#include "materials/wrappers.h"
#include "scene/builder.h"

namespace duet {

MaterialPointer TwoSidedMaterial::build(SceneBuilder& b, const SourceLocation& where) const {
  const Material *on_front = b.material(front), *on_back = b.material(back);
  if (!on_front || !on_back) return nullptr;
  if (on_front->transmits() || on_back->transmits()) {
    b.diagnostics().error(where, "a BSDF that lets light through cannot be in a \"twosided\" one");
    return nullptr;
  }
  return std::make_unique<TwoSided>(*on_front, *on_back);
}

MaterialPointer MaskMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const FloatSlot slot = b.slot(opacity);
  const Material* masked = b.material(nested);
  return masked ? std::make_unique<Mask>(slot, *masked) : nullptr;
}

MaterialPointer BlendMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const FloatSlot slot = b.slot(weight);
  const Material *one = b.material(first), *other = b.material(second);
  return one && other ? std::make_unique<Blend>(slot, *one, *other) : nullptr;
}

MaterialPointer MixtureMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  std::vector<Mixture::Part> made;
  for (const auto& [weight, id] : parts) {
    const Material* part = b.material(id);
    if (!part) return nullptr;
    made.push_back({float(weight), part});
  }
  return std::make_unique<Mixture>(std::move(made));
}

MaterialPointer BumpMapMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const FloatSlot slot = b.slot(height);
  const Material* base = b.material(nested);
  if (!base) return nullptr;
  return std::make_unique<BumpMap>(
      slot, float(scale), follows_curvature,
      TiltOptions{flip_invalid_normals, use_shadowing_function, drops_leaks}, *base);
}

MaterialPointer NormalMapMaterial::build(SceneBuilder& b, const SourceLocation&) const {
  const ColorSlot slot = b.slot(normals);
  const Material* base = b.material(nested);
  if (!base) return nullptr;
  return std::make_unique<NormalMap>(
      slot, TiltOptions{flip_invalid_normals, use_shadowing_function, drops_leaks}, *base);
}

}  // namespace duet
