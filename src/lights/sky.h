// The light of a clear sky and of the sun in it.
#pragma once

#include <array>

#include "lights/environment.h"

namespace duet {

/// A sun of given brightness, in the sky's own space; the horizon does not cut it.
struct SkyDisk {
  Vector3f direction{0, 0, 1};  ///< unit, to its middle
  Spectrum irradiance{1.0f};    ///< on a plane across that direction
};

struct SkyOptions {
  double turbidity = 3;   ///< of the air, from 1 to 10
  Spectrum albedo{0.3f};  ///< of the ground, from 0 to 1
  Vector3f sun{0, 0, 1};  ///< unit direction to the sun, in the sky's own space, whose +z is up
  double sky_scale = 1, sun_scale = 1;
  double sun_aperture = 0.5358;  ///< degrees, across; the sun's irradiance does not depend on it
  std::optional<SkyDisk> disk;   ///< instead of Hosek and Wilkie's sun, which stands at `sun`
  double stretch = 1;            ///< from 1 to 2: draws the sky below the horizon
  bool extend = false;           ///< the horizon's colour goes on below, fading
};

/// Radiance of the sky over the upper half of all directions; nothing if the sun is below the
/// horizon. Source: Hosek & Wilkie, "An Analytic Model for Full Spectral Sky-Dome Radiance", 2012,
/// and "Adding a Solar-Radiance Function to the Hosek-Wilkie Skylight Model", 2013; any disk of the
/// sun has the same radiance everywhere. Units are those of Mitsuba's RGB variants.
class Sky final : public EnvironmentLight {
 public:
  /// Only the rotation (and mirroring) of the transform counts.
  Sky(const SkyOptions& options, const Matrix4& to_world);

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  Spectrum emitted(const Point3f&, const Vector3f& wi) const override;
  PdfW pdf_direct(const Point3f&, const Vector3f& wi) const override;
  double power(double scene_radius) const override;

 private:
  /// Of the unit direction w in the sky's space.
  Spectrum sky(const Vector3f& w) const;
  Spectrum radiance(const Vector3f& w, bool in_sun) const;
  bool in_sun(const Vector3f& w) const { return length_squared(w - disk_) <= sun_chord2_; }
  float density(const Vector3f& w, bool in_sun) const;
  void tabulate();

  /// Fields of equal solid angle by which directions are chosen.
  static constexpr int kRows = 64, kColumns = 64;

  Frame axes_;
  std::array<Spectrum, 9> shape_;  ///< the parameters A to I of the model
  Spectrum zenith_;                ///< what the model's shape is multiplied by
  Vector3f sun_;                   ///< what the sky's glow is around
  Vector3f disk_;                  ///< the middle of the sun's disk
  Frame disk_frame_;
  Spectrum sun_radiance_;
  float one_minus_cos_sun_, sun_chord2_, sun_density_;
  float stretch_;
  bool extend_, shines_;
  bool horizon_cuts_sun_;
  float lowest_ = 0;  ///< cosine from the zenith where the sky ends
  DiscreteDistribution cells_;
  float cell_density_;  ///< of a field that has all the probability
  float sun_share_ = 0;
  double mean_ = 0;  ///< luminance over the sphere
};

}  // namespace duet
