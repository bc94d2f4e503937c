// How a material makes a Bsdf: component by component, in the frames and shares of its wrappers.
#pragma once

#include "materials/bsdf.h"

namespace duet {

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
  /// Tilt. Not more than kMaxCovers of these and coats can be nested in one another.
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

}  // namespace duet
