#include "media/heterogeneous.h"

namespace duet {

namespace {

/// Rounding may put a value a little above its majorant, never far.
constexpr float kMajorantSlack = 1.0001f;

/// Transmittance below which shadow rays go on by Russian roulette.
constexpr float kRouletteTransmittance = 0.1f;

}  // namespace

HeterogeneousMedium::HeterogeneousMedium(const GridVolume& sigma_t, float scale,
                                         const ColorVolumeSlot& albedo, const PhaseFunction& phase)
    : Medium(phase),
      sigma_t_(sigma_t),
      scale_(scale),
      albedo_(albedo),
      majorants_(sigma_t, scale * phase.max_extinction() * kMajorantSlack),
      is_grey_(sigma_t.channels() == 1),
      is_microflake_(phase.is_microflake()) {}

inline Spectrum HeterogeneousMedium::extinction(const Point3f& local, const Ray& ray,
                                                float t) const {
  Spectrum s = is_grey_ ? Spectrum(sigma_t_.local_value(local)) : sigma_t_.local_color(local);
  s *= scale_;
  if (is_microflake_) s *= phase().extinction(ray.origin + ray.direction * t, -ray.direction);
  return s;
}

template <class Collide>
inline void HeterogeneousMedium::track(const Ray& ray, float u, RandomStream& random,
                                       Collide collide) const {
  const Point3f origin = sigma_t_.to_local(ray.origin);
  const Vector3f direction = sigma_t_.to_local(ray.direction);
  float depth = -std::log1p(-u);  // optical, in terms of the majorant, to the next collision
  majorants_.traverse(ray, origin, direction, [&](float t, float end, float majorant) {
    for (;;) {
      const float left = (end - t) * majorant;
      if (!(depth < left)) {
        depth -= left;
        return true;
      }
      t += depth / majorant;
      depth = -std::log1p(-random.next());
      if (!collide(t, majorant, extinction(origin + direction * t, ray, t))) return false;
    }
  });
}

float HeterogeneousMedium::sample_distance(const Ray& ray, float u, RandomStream& random,
                                           SpectralWeights& w) const {
  float scattered = INFINITY;
  track(ray, u, random, [&](float t, float majorant, const Spectrum& sigma_t) {
    const float chosen = sigma_t[w.channel];
    if (random.next() * majorant < chosen) {
      const Spectrum density = is_grey_ ? Spectrum(1) : sigma_t / chosen;
      w.pdf *= density;
      w.value *= density * albedo_(ray.origin + ray.direction * t);
      scattered = t;
      return false;
    }
    // A null collision. A light sample would not have stopped here whatever happened.
    const float missed = majorant - chosen;
    if (!is_grey_) {
      const Spectrum density = (Spectrum(majorant) - sigma_t) / missed;
      w.pdf *= density;
      w.value *= density;
    }
    w.light *= majorant / missed;
    return true;
  });
  return scattered;
}

void HeterogeneousMedium::transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const {
  track(ray, random.next(), random, [&](float, float majorant, const Spectrum& sigma_t) {
    const Spectrum density = (Spectrum(majorant) - sigma_t) / majorant;
    w.value *= density;
    w.pdf *= density;
    const float most = w.value.max();
    if (!(most < kRouletteTransmittance)) return true;
    if (!(random.next() * kRouletteTransmittance < most)) {
      w.value = Spectrum();
      return false;
    }
    w.value *= kRouletteTransmittance / most;
    return true;
  });
}

float HeterogeneousMedium::nominal_extinction(const Point3f& p) const {
  const Point3f local = sigma_t_.to_local(p);
  return scale_ * (is_grey_ ? sigma_t_.local_value(local) : sigma_t_.local_color(local).mean());
}

std::optional<Bounds> HeterogeneousMedium::bounds() const {
  Bounds box;
  sigma_t_.world_box(box.lower, box.upper);
  return box;
}

}  // namespace duet
