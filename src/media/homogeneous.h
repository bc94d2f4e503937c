// A medium with the same extinction everywhere.
#pragma once

#include "media/medium.h"

namespace duet {

/// Distances are sampled exactly and transmittances known (Beer–Lambert law). The albedo may vary,
/// unless the medium emits; the particles of the phase function must be the same everywhere.
class HomogeneousMedium final : public Medium {
 public:
  /// `emission` is constant radiance L_e.
  HomogeneousMedium(const Spectrum& sigma_t, const ColorVolumeSlot& albedo,
                    const PhaseFunction& phase, const Spectrum& emission = {});
  float sample_distance(const Ray& ray, float u, RandomStream& random,
                        SpectralWeights& w) const override;
  void transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const override;
  Spectrum emitted(const Ray& ray, RandomStream& random) const override;
  /// Means over the colour channels, the density of a sub-path for a random one of them.
  float nominal_transmittance(const Ray& ray) const override;
  float nominal_extinction(const Point3f&) const override { return sigma_t_.mean(); }

 private:
  /// For light along the ray.
  Spectrum extinction(const Ray& ray) const;
  /// From ray.origin to ray.tmax.
  Spectrum transmittance(const Ray& ray) const;

  Spectrum sigma_t_;
  ColorVolumeSlot albedo_;
  Spectrum emission_;
  bool is_microflake_;
};

}  // namespace duet
