// The phase function of Henyey and Greenstein, for layers that are seen as surfaces.
#pragma once

#include "math/frame.h"
#include "math/trig.h"

namespace duet {

/// Per solid angle; the cosine is that of the deflection, `g` in (−1, 1) its mean. Also the density
/// of sample_henyey_greenstein().
/// Source: Henyey & Greenstein, "Diffuse Radiation in the Galaxy", 1941.
inline float henyey_greenstein(float cosine, float g) {
  const float d = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * kPi * std::max(d * std::sqrt(d), 1e-9f));
}

/// A unit direction that is deflected from the unit direction `along`.
inline Vector3f sample_henyey_greenstein(const Vector3f& along, float g, const Point2f& v) {
  float cosine = 1 - 2 * v.y;
  if (std::abs(g) > 1e-3f) {
    const float s = (1 - g * g) / (1 - g + 2 * g * v.y);
    cosine = std::clamp((1 + g * g - s * s) / (2 * g), -1.0f, 1.0f);
  }
  const float sine = safe_sqrt(1 - cosine * cosine);
  float sin_phi, cos_phi;
  sincos_turns(v.x, sin_phi, cos_phi);
  return Frame(Normal3f(along)).to_world({sine * cos_phi, sine * sin_phi, cosine});
}

}  // namespace duet
