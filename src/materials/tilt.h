// What a bump or normal map does to the frame of the materials that it covers.
//
// Mitsuba 3 treats the two directions of scattering differently: the perturbed normal is turned to
// the side of the direction towards the eye, and the direction towards the light is shadowed. For
// light that is traced from its source the roles of wo and wi are therefore exchanged here, so that
// both kinds of path see the same surface.
#pragma once

#include "math/frame.h"

namespace duet {

struct TiltOptions {
  /// The normal is turned by 180 degrees about z if the eye would see it from behind.
  /// Source: Schüssler et al., "Microfacet-based Normal Mapping for Robust Monte Carlo Path
  /// Tracing", 2017.
  bool faces_eye = true;
  /// Light is attenuated at grazing angles.
  /// Source: Estevez et al., "A Microfacet-Based Shadowing Function to Solve the Bump Terminator
  /// Problem", 2019.
  bool shadows = true;
  /// Light carries nothing if the surface and its perturbed frame have it on different sides. pbrt
  /// lets it through.
  bool drops_leaks = true;
};

/// A perturbed normal in the local frame of the surface. Directions are given in that frame.
class Tilt {
 public:
  Tilt() = default;
  /// `n` has unit length; `side` is −1 if the surface's frame is mirrored.
  Tilt(const Normal3f& n, const TiltOptions& options, float side)
      : frame_(frame_around(n)),
        side_(side),
        faces_eye_(options.faces_eye),
        drops_leaks_(options.drops_leaks) {
    const float z2 = n.z * n.z;
    alpha2_ = options.shadows ? (8 * z2 > 1 - z2 ? 0.125f * (1 - z2) / z2 : 1.0f) : 0.0f;
  }

  /// The frame around a perturbed normal of unit length, both in the local frame of the surface.
  static Frame frame_around(const Normal3f& n) {
    // Tangents as Mitsuba chooses them; any will do where that choice is undefined.
    const Vector3f x = Vector3f(1, 0, 0) - Vector3f(n) * n.x;
    return length_squared(x) > 1e-12f ? Frame::from_tangent(n, x) : Frame(n);
  }

  /// Whether the normal is turned for an eye in direction `v`.
  bool turned_for(const Vector3f& v) const {
    return faces_eye_ && v.z * (dot(frame_.n, mirrored(v)) * side_) <= 0;
  }
  /// Probability with which a sampler that does not know the eye's direction turns the normal: the
  /// projected solid angle of the directions for which it is turned, over π.
  float turned_probability() const { return faces_eye_ ? 0.5f * (1 - frame_.n.z) : 0.0f; }

  /// Into the perturbed frame, and back.
  Vector3f to_local(const Vector3f& v, bool turned) const {
    const Vector3f w = mirrored(v);
    if (!turned) return frame_.to_local(w);
    // The turned frame is the mirror image of the other, with its normal the other way.
    const Vector3f l = frame_.to_local({w.x, w.y, -w.z});
    return {l.x, l.y, -l.z};
  }
  Vector3f from_local(const Vector3f& l, bool turned) const {
    if (!turned) return mirrored(frame_.to_world(l));
    const Vector3f w = frame_.to_world({l.x, l.y, -l.z});
    return mirrored({w.x, w.y, -w.z});
  }
  /// Whether light from `v` counts: the surface itself has it on the side on which the perturbed
  /// frame has it, or leaks are not dropped.
  bool agrees(const Vector3f& v, const Vector3f& local) const {
    return !drops_leaks_ || v.z * side_ * local.z > 0;
  }

  /// The perturbed normal, in the frame of the surface.
  Vector3f normal(bool turned) const { return from_local({0, 0, 1}, turned); }
  /// Factor for light from direction `v`: Smith's masking function.
  float shadowing(const Vector3f& v) const {
    const float z = std::abs(v.z);
    return 2 * z / (z + std::sqrt(z * z + alpha2_ * std::max(1 - z * z, 0.0f)));
  }

 private:
  Vector3f mirrored(const Vector3f& v) const { return {v.x, v.y, v.z * side_}; }

  Frame frame_;
  float side_;
  float alpha2_;  ///< squared roughness of the shadowing
  bool faces_eye_, drops_leaks_;
};

}  // namespace duet
