// A medium whose extinction is given by a grid.
#pragma once

#include "media/majorant_grid.h"
#include "media/medium.h"

namespace duet {

/// Distances are sampled by delta tracking (Woodcock et al. 1965) and transmittances estimated by
/// ratio tracking (Novák, Selle & Jarosz 2014), both against a coarse grid of majorants, so that
/// empty space costs little. Outside of the box
/// around the grid there is nothing.
class HeterogeneousMedium final : public Medium {
 public:
  /// The extinction is `scale` times the grid's values, times that of the phase function.
  HeterogeneousMedium(const GridVolume& sigma_t, float scale, const ColorVolumeSlot& albedo,
                      const PhaseFunction& phase);
  float sample_distance(const Ray& ray, float u, RandomStream& random,
                        SpectralWeights& w) const override;
  void transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const override;
  /// What it really is would have to be estimated.
  float nominal_transmittance(const Ray&) const override { return 1; }
  float nominal_extinction(const Point3f& p) const override;
  std::optional<Bounds> bounds() const override;

 private:
  /// The extinction at a point, given in the grid's space and in the world.
  Spectrum extinction(const Point3f& local, const Ray& ray, float t) const;
  /// Meets the possible collisions along the ray, distributed by the majorants, until `collide(t,
  /// majorant, extinction)` returns false. `u` decides where the first is, `random` the others.
  template <class Collide>
  void track(const Ray& ray, float u, RandomStream& random, Collide collide) const;

  const GridVolume& sigma_t_;
  float scale_;
  ColorVolumeSlot albedo_;
  MajorantGrid majorants_;
  bool is_grey_, is_microflake_;
};

}  // namespace duet
