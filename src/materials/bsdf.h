// Material interface: a Material is attached to surfaces, a Bsdf is what it becomes at a hit.
#pragma once

#include "geometry/surface.h"
#include "materials/cover.h"
#include "materials/models.h"

namespace duet {

class Texture;

struct BsdfEval {
  Spectrum value;  ///< f |cos θ_i| without delta lobes
  PdfW pdf;
};

/// The same with the density of the reverse direction; see Bsdf::reverse_pdf().
struct BsdfPair {
  Spectrum value;
  PdfW pdf, reverse;
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
  /// Which of the Bsdf's covers lie over it (bump and normal maps, coats), the outer one first; −1
  /// for none.
  int8_t covers[kMaxCovers];
  /// −1 if a two-sided material is seen from its back: the z axis is then mirrored (after the
  /// covers).
  float side;
  float share;  ///< weight within the mixture and probability of being picked
  ModelUnion model;
};

/// A small closed value with plain numbers, bound to a shading frame and to the direction wo. To
/// ask it again costs no texture lookup. Mixtures (blends, masks) are lists of components whose
/// shares sum to at most one.
///
/// The two transports describe the same surface: with respect to the shading normal n, the value
/// for importance with wo = l and wi = v, over |v·n|, is the value for radiance with wo = v and wi
/// = l, over |l·n|. This holds for refraction, which scales only the latter by squared indices, and
/// under bump maps, which scale the former by what they do to the cosines.
/// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 5.3.
class Bsdf {
 public:
  /// More components in one material are refused when the scene is built.
  static constexpr int kMaxComponents = 6;

  Bsdf() {}

  /// Value and density for the unit world direction wi.
  BsdfEval eval(const Vector3f& wi, Transport transport) const;
  /// Density with which a path that arrives from wi and carries the opposite of `transport` would
  /// be sent to wo, if the value of this pair is not zero. Delta lobes are left out; each has the
  /// same probability from both ends, except under bump maps that turn normals towards the eye.
  PdfW reverse_pdf(const Vector3f& wi, Transport transport) const;
  /// eval() and, where the value is not zero, reverse_pdf() at once.
  BsdfPair eval_both_ways(const Vector3f& wi, Transport transport) const;
  /// `u` picks the component and the lobe, `v` the direction.
  std::optional<BsdfSample> sample(float u, const Point2f& v, Transport transport) const;
  /// What passes straight through, as if there were no surface, including the probability of the
  /// lobes that let it pass.
  Spectrum straight_through() const;
  /// Whether any lobe can be met by a connection or a light sample.
  bool has_smooth() const { return has_smooth_; }
  bool has_delta() const { return has_delta_; }
  /// Whether sample() looks at `u`.
  bool needs_choice() const { return needs_choice_; }
  /// Whether photons may be merged here at all: not where most of the light is scattered by lobes
  /// that are nearly specular (kNearlySpecular). Light that arrives a little beside a point is
  /// scattered in quite another way by these, so that merging would blur and brighten what they
  /// show. The answer is the same for all directions.
  bool merges() const { return nearly_specular_share_ <= kMostNearlySpecular * smooth_share_; }
  /// The same for light that is scattered with a density, and a reverse_pdf(): where the smaller
  /// part of it meets nearly specular lobes, nothing is merged within them. The answer is the same
  /// from both ends.
  bool merges(float pdf, float reverse) const {
    return merges() && !(has_nearly_specular() && std::max(pdf, reverse) > kDensestMerged);
  }
  bool has_nearly_specular() const { return nearly_specular_share_ > 0; }

  const Frame& frame() const { return frame_; }
  int component_count() const { return count_; }
  const BsdfComponent& component(int i) const { return components_[i]; }

 private:
  friend class BsdfBuilder;
  friend class Material;

  /// Share of nearly specular lobes among the smooth ones up to which photons are merged.
  static constexpr float kMostNearlySpecular = 0.5f;
  /// Per solid angle: that of the reflection off facets with α = kNearlySpecular at its peak.
  static constexpr float kDensestMerged = float(1 / (4 * kPi * kNearlySpecular * kNearlySpecular));

  bool is_plain_diffuse() const {
    return count_ == 1 && components_[0].kind == ModelKind::diffuse && components_[0].covers[0] < 0;
  }
  BsdfEval eval_all(const Vector3f& wi, Transport transport) const;
  PdfW reverse_pdf_all(const Vector3f& wi, Transport transport) const;
  std::optional<BsdfSample> sample_all(float u, const Point2f& v, Transport transport) const;

  Frame frame_;
  Vector3f wo_;  ///< in the shading frame
  int count_ = 0, cover_count_ = 0;
  bool has_smooth_ = false, has_delta_ = false, needs_choice_ = false;
  /// Of the components with smooth lobes, in sum; and what is nearly specular of it.
  float smooth_share_ = 0, nearly_specular_share_ = 0;
  union {  // keeps unused components untouched
    BsdfComponent components_[kMaxComponents];
  };
  union {
    Cover covers_[kMaxComponents];
  };
};

/// A material that is the same everywhere and has one component: bound once, when it is made.
struct ConstantMaterial {
  BsdfComponent component;
  bool has_smooth, has_delta, needs_choice;
  float nearly_specular_share;
  bool two_sided;  ///< the back looks like the front
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
    BsdfComponent& c = bsdf_.components_[bsdf_.count_++];
    set_model(c, model);
    complete(c, model.has_smooth(), model.has_delta(), model.needs_choice(),
             nearly_specular_share(model));
  }
  void add(const ConstantMaterial& constant) {
    BsdfComponent& c = bsdf_.components_[bsdf_.count_++];
    c = constant.component;
    const float side = constant.two_sided && wo_.z < 0 ? -1.0f : 1.0f;
    complete(c, constant.has_smooth, constant.has_delta, constant.needs_choice,
             constant.nearly_specular_share);
    c.side *= side;
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
    inner.side_ = -side_;
    inner.wo_.z = -wo_.z;
    bind_nested(inner);
  }
  /// Runs `bind_nested` in a frame around the unit normal `n`, given in the current frame; see
  /// Tilt. Not to be nested within another one, nor more than kMaxCovers of these and coats.
  template <class F>
  void tilted(const Normal3f& n, const TiltOptions& options, F&& bind_nested) {
    BsdfBuilder inner(*this);
    inner.tilt(Tilt(n, options, side_));
    bind_nested(inner);
  }

  /// Runs `bind_nested` below a coat.
  template <class F>
  void coated(const Coat& coat, F&& bind_nested) {
    BsdfBuilder inner(*this);
    // The mirroring so far is that of the coat's surroundings: the coat is the same on both sides.
    inner.add_cover().set(coat);
    inner.wo_ = coat.inside(wo_);
    bind_nested(inner);
  }

 private:
  void complete(BsdfComponent& c, bool has_smooth, bool has_delta, bool needs_choice,
                float nearly_specular) {
    for (int i = 0; i < kMaxCovers; ++i) c.covers[i] = covers_[i];
    c.side = side_;
    c.share = share_;
    bsdf_.has_smooth_ |= has_smooth;
    bsdf_.has_delta_ |= has_delta;
    if (has_smooth) {
      bsdf_.smooth_share_ += share_;
      bsdf_.nearly_specular_share_ += share_ * nearly_specular;
    }
    // A tilt is chosen too, where the direction towards the eye is not yet known.
    bsdf_.needs_choice_ |= needs_choice || bsdf_.count_ > 1 || share_ < 1 || covers_[0] >= 0;
  }
  Cover& add_cover() {
    int8_t* const free = covers_[0] < 0 ? &covers_[0] : &covers_[1];
    *free = int8_t(bsdf_.cover_count_);
    return bsdf_.covers_[bsdf_.cover_count_++];
  }
  void tilt(const Tilt& tilt) {
    add_cover().set(tilt);
    // wo_ is mirrored already, which is part of the tilt.
    const Vector3f shading(wo_.x, wo_.y, wo_.z * side_);
    wo_ = tilt.to_local(shading, tilt.turned_for(shading));
    side_ = 1;
  }

  Bsdf& bsdf_;
  Vector3f wo_;
  float share_ = 1;
  float side_ = 1;
  int8_t covers_[kMaxCovers] = {-1, -1};
};

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
  /// Whether there is a bump or normal map in it: these cannot be nested in one another.
  virtual bool perturbs() const { return false; }
  /// The texture that bind() is most likely to wait for, or null.
  virtual const Texture* main_texture() const { return nullptr; }
  /// How many bump maps, normal maps and coats lie over each other at most.
  virtual int cover_count() const { return 0; }
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
