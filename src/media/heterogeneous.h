// A medium whose extinction varies in space.
#pragma once

#include "media/cloud.h"
#include "media/emission.h"
#include "media/majorant_grid.h"
#include "media/medium.h"

namespace duet {

/// Distances are sampled by delta tracking (Woodcock et al. 1965) and transmittances estimated by
/// ratio tracking (Novák, Selle & Jarosz 2014), both against a coarse grid of majorants, so that
/// empty space costs little. `Volume` is GridVolume or CloudVolume; outside of the box around it
/// there is nothing.
template <class Volume>
class HeterogeneousMedium final : public Medium {
 public:
  /// The extinction is `scale` times the volume's values, times that of the phase function.
  HeterogeneousMedium(const Volume& sigma_t, float scale, const ColorVolumeSlot& albedo,
                      const PhaseFunction& phase,
                      std::optional<MediumEmission> emission = std::nullopt);
  float sample_distance(const Ray& ray, float u, RandomStream& random,
                        SpectralWeights& w) const override;
  void transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const override;
  Spectrum emitted(const Ray& ray, RandomStream& random) const override;
  /// What it really is would have to be estimated.
  float nominal_transmittance(const Ray&) const override { return 1; }
  float nominal_extinction(const Point3f& p) const override;
  std::optional<Bounds> bounds() const override;

 private:
  /// The extinction at a point, given in the volume's space and in the world.
  Spectrum extinction(const Point3f& local, const Ray& ray, float t) const;
  /// Meets the possible collisions along the ray, distributed by the majorants, until `collide(t,
  /// majorant, extinction)` returns false. `u` decides where the first is, `random` the others.
  template <class Collide>
  void track(const Ray& ray, float u, RandomStream& random, Collide collide) const;

  Volume sigma_t_;
  float scale_;
  ColorVolumeSlot albedo_;
  std::optional<MediumEmission> emission_;
  MajorantGrid majorants_;
  bool is_grey_, is_microflake_;
};

}  // namespace duet
