// A hair or fur fibre: light is reflected by it, goes through it, or runs around inside it.
#pragma once

#include "materials/model.h"

namespace duet {

/// How light leaves a fibre depends on how often it crossed the inside: p = 0 (reflection), 1, 2,
/// and all the others together.
/// Source: Chiang, Bitterli, Tappan & Burley, "A Practical and Controllable Hair and Fur Model for
/// Production Path Tracing", 2016; longitudinal lobes by d'Eon et al., "An Energy-Conserving Hair
/// Reflectance Model", 2011.
///
/// The fibre runs along the frame's y axis. The point where the view meets it says how far it is
/// from the fibre's middle; light leaves where it entered. The model is made for radiance: for
/// importance the two directions are exchanged, and the cosines with them.
class HairModel {
 public:
  /// Crossings that have a lobe of their own.
  static constexpr int kLobes = 3;

  /// Roughnesses lie in [0, 1]; `tilt` of the cuticle's scales is in radians; absorption is per
  /// radius of the fibre; `eta` is the index of the inside over that of the outside.
  HairModel(float longitudinal_roughness, float azimuthal_roughness, float tilt, float eta,
            const Spectrum& absorption);

  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return true; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;

 private:
  /// What follows from the direction in which the path goes on from the fibre.
  struct View;
  View view(const Vector3f& w) const;
  ModelEval eval_from(const View& view, const Vector3f& w) const;
  ModelEval eval_both(const View& view, const Vector3f& wo, const Vector3f& wi,
                      Transport transport) const;

  float variance_[kLobes + 1];
  float logistic_scale_, logistic_norm_;
  /// Of the angles by which the scales turn each lobe.
  float sin_turn_[kLobes], cos_turn_[kLobes];
  float eta_;
  Spectrum absorption_;
};

/// Absorption per radius of hair with these concentrations of pigments. Source: d'Eon et al. 2011,
/// for RGB.
inline Spectrum hair_absorption(float eumelanin, float pheomelanin) {
  return Spectrum(0.419f, 0.697f, 1.37f) * eumelanin + Spectrum(0.187f, 0.4f, 1.05f) * pheomelanin;
}

}  // namespace duet
