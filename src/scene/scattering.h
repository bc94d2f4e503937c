// How a BSDF scatters light, as far as methods and messages tell BSDFs apart.
#pragma once

namespace duet {

/// Of a BSDF by itself, without those that are nested in it. Several can hold: smooth plastic is
/// diffuse and a mirror.
struct Scattering {
  bool diffuse = false;
  bool rough_reflection = false, rough_refraction = false;  ///< microfacets and other glossy lobes
  bool mirror = false, smooth_glass = false;                ///< delta distributions
  bool see_through = false;  ///< lets light pass straight through, partly or wholly
  bool bumps = false;        ///< perturbs the normals of what is nested
  /// Lets light through in another way than those above.
  bool translucent = false;

  /// Whether light can pass to the other side.
  bool transmits() const { return rough_refraction || smooth_glass || see_through || translucent; }
  bool has_delta_lobe() const { return mirror || smooth_glass; }
  bool has_smooth_lobe() const { return diffuse || rough_reflection || rough_refraction; }
};

}  // namespace duet
