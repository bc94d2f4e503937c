// Medium interface: how far light gets in them and where it is scattered.
#pragma once

#include <optional>

#include "geometry/shape.h"
#include "media/phase.h"
#include "media/random_stream.h"
#include "media/spectral_weights.h"
#include "media/volume.h"

namespace duet {

/// A medium that scatters, absorbs and may emit. Rays have unit directions.
class Medium {
 public:
  Medium(const PhaseFunction& phase, bool emits) : phase_(phase), emits_(emits) {}
  virtual ~Medium() = default;
  const PhaseFunction& phase() const { return phase_; }
  bool emits() const { return emits_; }

  /// Follows the ray to where it is scattered next and returns the distance, or INFINITY if
  /// it comes to ray.tmax before. The weights then include everything up to there: transmittance,
  /// the scattering coefficient, the densities of each channel. `u` is used first, then `random`.
  virtual float sample_distance(const Ray& ray, float u, RandomStream& random,
                                SpectralWeights& w) const = 0;
  /// Multiplies the weights of a shadow ray by an estimate of the transmittance up to ray.tmax, and
  /// by the densities of a sub-path that would have gone all the way.
  virtual void transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const = 0;

  /// An unbiased estimate of the radiance that the medium emits between ray.origin and ray.tmax, as
  /// it arrives at ray.origin: ∫ T(t) σ_a(t) L_e(t) dt. Only of media that emit.
  virtual Spectrum emitted(const Ray& ray, RandomStream& random) const = 0;

  /// What the densities that multiple importance sampling compares have for the transmittance from
  /// ray.origin to ray.tmax, and for the extinction at a point where light is scattered. All
  /// techniques have to agree on the two, so they depend on nothing else; a way back is worth the
  /// same as the way there. What sub-paths really do may differ.
  virtual float nominal_transmittance(const Ray& ray) const = 0;
  virtual float nominal_extinction(const Point3f& p) const = 0;

  /// A box outside of which the medium is empty; none if it has no end.
  virtual std::optional<Bounds> bounds() const { return std::nullopt; }

 private:
  const PhaseFunction& phase_;
  bool emits_;
};

}  // namespace duet
