// Whether the rays that start at a light carry the light that points find by asking for it.
#pragma once

#include <string>

#include "lights/light.h"

namespace duet::test {

/// A disk that counts the light that passes through it against its normal.
struct Probe {
  Point3f center;
  Vector3f normal;  ///< of any length
  float radius = 1;
};

/// Estimates the flux through a probe, all of it unshadowed, by emitted rays and by sample_direct()
/// at points of the probe, and checks that the two agree and are known to about one per cent.
void check_flux(const Light& light, const Probe& probe, const std::string& name);

}  // namespace duet::test
