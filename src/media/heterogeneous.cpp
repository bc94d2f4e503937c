#include "media/heterogeneous.h"

namespace duet {

namespace {

/// Rounding may put a value a little above its majorant, never far.
constexpr float kMajorantSlack = 1.0001f;

/// Transmittance below which shadow rays go on by Russian roulette.
constexpr float kRouletteTransmittance = 0.1f;

/// Russian roulette for a transmittance; false if it ends, and is zero then.
bool survives(Spectrum& transmittance, RandomStream& random) {
  const float most = transmittance.max();
  if (!(most < kRouletteTransmittance)) return true;
  if (!(random.next() * kRouletteTransmittance < most)) {
    transmittance = Spectrum();
    return false;
  }
  transmittance *= kRouletteTransmittance / most;
  return true;
}

}  // namespace

template <class Volume>
HeterogeneousMedium<Volume>::HeterogeneousMedium(const Volume& sigma_t, float scale,
                                                 const ColorVolumeSlot& albedo,
                                                 const PhaseFunction& phase,
                                                 std::optional<MediumEmission> emission)
    : Medium(phase, emission.has_value()),
      sigma_t_(sigma_t),
      scale_(scale),
      albedo_(albedo),
      emission_(std::move(emission)),
      majorants_(sigma_t, scale * phase.max_extinction() * kMajorantSlack),
      is_grey_(sigma_t.channels() == 1),
      is_microflake_(phase.is_microflake()) {}

template <class Volume>
inline Spectrum HeterogeneousMedium<Volume>::extinction(const Point3f& local, const Ray& ray,
                                                        float t) const {
  Spectrum s = is_grey_ ? Spectrum(sigma_t_.local_value(local)) : sigma_t_.local_color(local);
  s *= scale_;
  if (is_microflake_) s *= phase().extinction(ray.origin + ray.direction * t, -ray.direction);
  return s;
}

template <class Volume>
template <class Collide>
inline void HeterogeneousMedium<Volume>::track(const Ray& ray, float u, RandomStream& random,
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

template <class Volume>
float HeterogeneousMedium<Volume>::sample_distance(const Ray& ray, float u, RandomStream& random,
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

template <class Volume>
void HeterogeneousMedium<Volume>::transmit(const Ray& ray, RandomStream& random,
                                           SpectralWeights& w) const {
  track(ray, random.next(), random, [&](float, float majorant, const Spectrum& sigma_t) {
    const Spectrum density = (Spectrum(majorant) - sigma_t) / majorant;
    w.value *= density;
    w.pdf *= density;
    return survives(w.value, random);
  });
}

template <class Volume>
Spectrum HeterogeneousMedium<Volume>::emitted(const Ray& ray, RandomStream& random) const {
  Spectrum sum, transmittance(1);
  track(ray, random.next(), random, [&](float t, float majorant, const Spectrum& sigma_t) {
    const Point3f p = ray.origin + ray.direction * t;
    sum += transmittance * (sigma_t / majorant) * (Spectrum(1) - albedo_(p)) * (*emission_)(p);
    transmittance *= (Spectrum(majorant) - sigma_t) / majorant;
    return survives(transmittance, random);
  });
  return sum;
}

template <class Volume>
float HeterogeneousMedium<Volume>::nominal_extinction(const Point3f& p) const {
  const Point3f local = sigma_t_.to_local(p);
  return scale_ * (is_grey_ ? sigma_t_.local_value(local) : sigma_t_.local_color(local).mean());
}

template <class Volume>
std::optional<Bounds> HeterogeneousMedium<Volume>::bounds() const {
  Bounds box;
  sigma_t_.world_box(box.lower, box.upper);
  return box;
}

template class HeterogeneousMedium<GridVolume>;
template class HeterogeneousMedium<CloudVolume>;

}  // namespace duet
