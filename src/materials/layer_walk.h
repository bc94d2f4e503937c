// Random walks of light between a coat and a base, as estimates of a layered BSDF.
#pragma once

#include "materials/layered.h"
#include "math/hash.h"

namespace duet {

/// Estimates for one model, by numbers that follow from a seed.
///
/// A walk enters through the coat from one direction and is scattered by base, layer and coat. At
/// each event it is joined with light that has entered from the other direction, in two ways that
/// are weighted by the balance heuristic: with a direction into which the coat refracted that
/// light, and by leaving through the coat in the direction in which the walk goes on. Nothing can
/// leave through a smooth coat in the second way, and smooth metal cannot be joined in the first.
class LayerWalk {
 public:
  LayerWalk(const LayeredModel& model, uint64_t seed) : m_(model), state_(seed) {}

  /// Of the model's value for light that has been in the layer, times eta²; without cosines. Both
  /// directions are above the surface. The mean is the same if they are exchanged.
  Spectrum estimate(const Vector3f& from, const Vector3f& to);

 private:
  /// Light from `to` within the layer, after it has been refracted.
  struct Entered {
    Vector3f direction;  ///< downwards
    float weight, pdf;
    bool exists, delta;
  };
  float next() { return to_unit_float(uint32_t(mix64(state_ += 0x9e3779b97f4a7c15ull) >> 32)); }
  Point2f next_2d();
  Entered enter(const Vector3f& w);
  bool at_base();
  bool at_coat();
  bool in_layer(int event);
  /// What the light has scattered in the layer, per albedo, towards the walk. Where coat and base
  /// are mirrors the light is followed on its way to and fro, as the walk could not find it.
  Spectrum light_at(int event) const;
  /// Joins the walk with the light by leaving through the coat. The direction was sampled with the
  /// density `pdf`; 0 if this is the only way to join them.
  void leave(float pdf);

  const LayeredModel& m_;
  uint64_t state_;
  Vector3f to_, w_;  ///< where the walk goes
  Entered light_;
  float depth_;  ///< below the coat
  Spectrum beta_, sum_;
};

}  // namespace duet
