// A medium with the same extinction everywhere.
#pragma once

#include "media/medium.h"

namespace duet {

/// Distances are sampled exactly and transmittances known (Beer–Lambert law). The albedo may vary,
/// the particles of the phase function must be the same everywhere.
class HomogeneousMedium final : public Medium {
 public:
  HomogeneousMedium(const Spectrum& sigma_t, const ColorVolumeSlot& albedo,
                    const PhaseFunction& phase)
      : Medium(phase), sigma_t_(sigma_t), albedo_(albedo), is_microflake_(phase.is_microflake()) {}
  float walk(const Ray& ray, float u, RandomStream& random, SpectralWeights& w) const override;
  void transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const override;

 private:
  /// For light along the ray.
  Spectrum extinction(const Ray& ray) const;

  Spectrum sigma_t_;
  ColorVolumeSlot albedo_;
  bool is_microflake_;
};

}  // namespace duet
