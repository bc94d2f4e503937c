// The doorway to materials: a Material is attached to surfaces, a Bsdf is what it becomes at a hit.
#pragma once

#include "geometry/surface.h"
#include "materials/models.h"

namespace duet {

struct BsdfEval {
  Spectrum value;  ///< f |cos θ_i| without delta lobes
  PdfW pdf;
};

struct BsdfSample {
  Vector3f wi;      ///< unit, in world space
  Spectrum weight;  ///< f |cos θ_i| / pdf
  PdfW pdf;         ///< of a delta lobe: the probability with which it was picked
  float eta = 1;    ///< index on the far side over that on the near side, 1 for reflection
  bool delta = false;
  bool null = false;  ///< passed straight through
};

/// One scattering model within a Bsdf.
struct BsdfComponent {
  ModelKind kind;
  bool perturbed;  ///< has a frame of its own (bump and normal maps)
  /// −1 if a two-sided material is seen from its back: the z axis is then mirrored.
  float side;
  float share;  ///< weight within the mixture and probability of being picked
  ModelUnion model;
};

/// A small closed value with plain numbers, bound to a shading frame and to the direction wo. To
/// ask it again costs no texture lookup. Mixtures (blends, masks) are lists of components whose
/// shares sum to at most one.
class Bsdf {
 public:
  /// More components in one material are refused when the scene is built.
  static constexpr int kMaxComponents = 6;

  Bsdf() {}

  /// Value and density for the unit world direction wi.
  BsdfEval eval(const Vector3f& wi, Transport transport) const;
  /// `u` picks the component and the lobe, `v` the direction.
  std::optional<BsdfSample> sample(float u, const Point2f& v, Transport transport) const;
  /// Whether any lobe can be met by a connection or a light sample.
  bool has_smooth() const { return has_smooth_; }
  bool has_delta() const { return has_delta_; }
  /// Whether sample() looks at `u`.
  bool needs_choice() const { return needs_choice_; }

  const Frame& frame() const { return frame_; }
  int component_count() const { return count_; }
  const BsdfComponent& component(int i) const { return components_[i]; }

 private:
  friend class BsdfBuilder;
  friend class Material;

  /// From the shading frame into that of component i, and back.
  Vector3f to_model(int i, const Vector3f& w) const;
  Vector3f from_model(int i, const Vector3f& w) const;
  /// A perturbed normal can put a direction on the other side than the surface does; such
  /// directions carry nothing.
  bool is_consistent(int i, const Vector3f& shading, const Vector3f& model) const;
  ModelEval eval_component(int i, const Vector3f& wi, Transport transport) const;

  Frame frame_;
  Vector3f wo_;  ///< in the shading frame
  int count_ = 0;
  bool has_smooth_ = false, has_delta_ = false, needs_choice_ = false;
  union {  // keeps unused components untouched
    BsdfComponent components_[kMaxComponents];
  };
  union {
    /// Relative to the shading frame, of perturbed components. May be left-handed: mirroring is
    /// part of it.
    Frame frames_[kMaxComponents];
  };
};

/// What a material's bind() adds its components to. Wrappers change the context in which their
/// nested materials bind.
class BsdfBuilder {
 public:
  /// `wo` is given in the shading frame.
  BsdfBuilder(Bsdf& bsdf, const Vector3f& wo) : bsdf_(bsdf), wo_(wo) {}

  /// Direction towards the previous vertex in the current frame.
  const Vector3f& wo() const { return wo_; }

  template <ScatteringModel M>
  void add(const M& model) {
    if (perturbed_) bsdf_.frames_[bsdf_.count_] = frame_;
    BsdfComponent& c = bsdf_.components_[bsdf_.count_++];
    set_model(c, model);
    c.perturbed = perturbed_;
    c.side = side_;
    c.share = share_;
    bsdf_.has_smooth_ |= model.has_smooth();
    bsdf_.has_delta_ |= model.has_delta();
    bsdf_.needs_choice_ |= model.needs_choice() || bsdf_.count_ > 1 || share_ < 1;
  }

  /// Runs `bind_nested` with the share multiplied by `factor`.
  template <class F>
  void with_share(float factor, F&& bind_nested) {
    if (!(factor > 0)) return;
    BsdfBuilder inner(*this);
    inner.share_ *= factor;
    bind_nested(inner);
  }
  /// Runs `bind_nested` on the mirrored side.
  template <class F>
  void flipped(F&& bind_nested) {
    BsdfBuilder inner(*this);
    inner.flip();
    bind_nested(inner);
  }
  /// Runs `bind_nested` with a frame given relative to the current one.
  template <class F>
  void in_frame(const Frame& frame, F&& bind_nested) {
    BsdfBuilder inner(*this);
    inner.perturb(frame);
    bind_nested(inner);
  }

 private:
  void flip();
  void perturb(const Frame& frame);

  Bsdf& bsdf_;
  Vector3f wo_;
  Frame frame_;  ///< relative to the shading frame
  float share_ = 1;
  float side_ = 1;
  bool perturbed_ = false;
};

/// A material of the scene: textures and parameters, immutable while rendering.
class Material {
 public:
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
      bsdf.components_[0] = constant_->component;
      if (constant_->two_sided && bsdf.wo_.z < 0) bsdf.components_[0].side = -1;
    } else {
      BsdfBuilder builder(bsdf, bsdf.wo_);
      bind(surface, builder);
    }
    return bsdf;
  }

  /// Adds this material's components at a surface point. May read what needs() asks for.
  virtual void bind(const Surface& surface, BsdfBuilder& builder) const = 0;
  virtual SurfaceNeeds needs() const = 0;
  /// Upper bound of the number of components that bind() adds.
  virtual int component_count() const = 0;
  /// Reflectance of the diffuse lobes, for the albedo layer.
  virtual Spectrum albedo(const Surface& surface) const = 0;
  /// Whether light can pass to the other side.
  virtual bool transmits() const = 0;

  /// A material that is the same everywhere and has one component is bound once, when it is made.
  struct Constant {
    BsdfComponent component;
    bool has_smooth, has_delta, needs_choice;
    bool two_sided;  ///< the back looks like the front
  };
  const Constant* constant() const { return constant_ ? &*constant_ : nullptr; }

 protected:
  /// To be called by the constructors of materials that are constant.
  template <ScatteringModel M>
  void set_constant(const M& model) {
    Constant c;
    set_model(c.component, model);
    c.component.perturbed = false;
    c.component.side = 1;
    c.component.share = 1;
    c.has_smooth = model.has_smooth();
    c.has_delta = model.has_delta();
    c.needs_choice = model.needs_choice();
    c.two_sided = false;
    constant_ = c;
  }
  void set_constant_two_sided(const Constant& front) {
    constant_ = front;
    constant_->two_sided = true;
  }

 private:
  std::optional<Constant> constant_;
};

}  // namespace duet
