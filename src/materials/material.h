// Material interface: a Material is attached to surfaces, a Bsdf is what it becomes at a hit.
#pragma once

#include <optional>
#include <vector>

#include "materials/bsdf_builder.h"

namespace duet {

class Texture;

/// A material of the scene: textures and parameters, immutable while rendering.
class Material {
 public:
  Material() = default;
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;
  virtual ~Material() = default;

  /// The material at a surface point, seen from the unit world direction `wo`.
  Bsdf bind(const Surface& surface, const Vector3f& wo) const {
    Bsdf bsdf;
    bsdf.frame_ = surface.shading;
    bsdf.wo_ = surface.shading.to_local(wo);
    if (constant_) {
      bsdf.count_ = 1;
      bsdf.has_smooth_ = constant_->has_smooth;
      bsdf.has_delta_ = constant_->has_delta;
      bsdf.needs_choice_ = constant_->needs_choice;
      bsdf.smooth_share_ = 1;
      bsdf.nearly_specular_share_ = constant_->nearly_specular_share;
      copy_component(bsdf.components_[0], constant_->component);
      if (constant_->two_sided && bsdf.wo_.z < 0) bsdf.components_[0].side = -1;
    } else {
      BsdfBuilder builder(bsdf, bsdf.wo_);
      add_components(surface, builder);
    }
    return bsdf;
  }
  /// Binds within another material: adds this material's components.
  void bind(const Surface& surface, BsdfBuilder& builder) const {
    if (constant_) {
      builder.add(*constant_);
    } else {
      add_components(surface, builder);
    }
  }

  /// What bind() and albedo() read of a surface.
  virtual SurfaceNeeds needs() const = 0;
  /// Upper bound of the number of components that bind() adds.
  virtual int component_count() const = 0;
  /// Whether light can pass to the other side.
  virtual bool transmits() const = 0;
  /// Whether light may pass straight through, as if there were no surface.
  virtual bool passes_straight() const { return false; }
  /// Whether there is a bump or normal map in it.
  virtual bool perturbs() const { return false; }
  /// Adds the textures that bind() is most likely to wait for, which are not null.
  virtual void list_textures(std::vector<const Texture*>&) const {}
  /// How many bump maps, normal maps and coats bind() adds.
  virtual CoverCount cover_count() const { return {}; }
  /// Reflectance for the albedo layer, seen from the unit world direction `wo`; as in Mitsuba 3
  /// that of the diffuse base, or π f for light along the normal where a model has none.
  Spectrum albedo(const Surface& surface, const Vector3f& wo) const {
    return local_albedo(surface, surface.shading.to_local(wo));
  }
  /// The same for `wo` in the shading frame.
  virtual Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const = 0;

  const ConstantMaterial* constant() const { return constant_ ? &*constant_ : nullptr; }

 protected:
  /// Adds this material's components at a surface point.
  virtual void add_components(const Surface& surface, BsdfBuilder& builder) const = 0;

  /// To be called by the constructors of materials that are constant.
  template <ScatteringModel M>
  void set_constant(const M& model) {
    ConstantMaterial c;
    set_model(c.component, model);
    c.component.covers[0] = c.component.covers[1] = -1;
    c.component.side = 1;
    c.component.share = 1;
    c.has_smooth = model.has_smooth();
    c.has_delta = model.has_delta();
    c.needs_choice = model.needs_choice();
    c.nearly_specular_share = nearly_specular_share(model);
    c.two_sided = false;
    constant_ = c;
  }
  void set_constant_two_sided(const ConstantMaterial& front) {
    constant_ = front;
    constant_->two_sided = true;
  }

 private:
  /// The most frequent model is small; to copy room for any other would cost more than to bind it.
  static void copy_component(BsdfComponent& to, const BsdfComponent& from) {
    if (from.kind != ModelKind::diffuse) {
      to = from;
      return;
    }
    set_model(to, from.model.diffuse);
    to.covers[0] = to.covers[1] = -1;
    to.side = to.share = 1;
  }

  std::optional<ConstantMaterial> constant_;
};

/// A material with one model, which `Derived` makes by
///   M model(const Surface&) const;
/// If nothing depends on the surface, its constructor calls set_constant().
template <class Derived>
class SingleModelMaterial : public Material {
 public:
  int component_count() const override { return 1; }
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override {
    return derived().model(surface).eval(wo, {0, 0, 1}, Transport::radiance).value * kPi;
  }

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override {
    builder.add(derived().model(surface));
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

}  // namespace duet
