#include "media/heterogeneous.h"

namespace duet {

namespace {

/// Rounding may put a value a little above its majorant, never far.
constexpr float kMajorantSlack = 1.0001f;

/// Shadow rays that carry less than this go on with some probability only.
constexpr float kFaint = 0.1f;

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

float HeterogeneousMedium::walk(const Ray& ray, float u, RandomStream& random,
                                SpectralWeights& w) const {
  const Point3f origin = sigma_t_.to_local(ray.origin);
  const Vector3f direction = sigma_t_.to_local(ray.direction);
  float depth = -std::log1p(-u);  // optical, in terms of the majorant, to the next collision
  float scattered = INFINITY;
  majorants_.traverse(ray, origin, direction, [&](float t, float end, float majorant) {
    for (;;) {
      const float left = (end - t) * majorant;
      if (!(depth < left)) {
        depth -= left;
        return true;
      }
      t += depth / majorant;
      depth = -std::log1p(-random.next());
      const Spectrum sigma_t = extinction(origin + direction * t, ray, t);
      const float chosen = sigma_t[w.channel];
      if (random.next() * majorant < chosen) {
        const Spectrum density = is_grey_ ? Spectrum(1) : sigma_t / chosen;
        w.walk *= density;
        w.value *= density * albedo_(ray.origin + ray.direction * t);
        scattered = t;
        return false;
      }
      // A null collision. A light sample would not have stopped here whatever happened.
      const float missed = majorant - chosen;
      if (!is_grey_) {
        const Spectrum density = (Spectrum(majorant) - sigma_t) / missed;
        w.walk *= density;
        w.value *= density;
      }
      w.light *= majorant / missed;
    }
  });
  return scattered;
}

void HeterogeneousMedium::transmit(const Ray& ray, RandomStream& random, SpectralWeights& w) const {
  const Point3f origin = sigma_t_.to_local(ray.origin);
  const Vector3f direction = sigma_t_.to_local(ray.direction);
  float depth = -std::log1p(-random.next());
  majorants_.traverse(ray, origin, direction, [&](float t, float end, float majorant) {
    for (;;) {
      const float left = (end - t) * majorant;
      if (!(depth < left)) {
        depth -= left;
        return true;
      }
      t += depth / majorant;
      depth = -std::log1p(-random.next());
      const Spectrum density =
          (Spectrum(majorant) - extinction(origin + direction * t, ray, t)) / majorant;
      w.value *= density;
      w.walk *= density;
      if (const float most = w.value.max(); most < kFaint) {
        if (!(random.next() * kFaint < most)) {
          w.value = Spectrum();
          return false;
        }
        w.value *= kFaint / most;
      }
    }
  });
}

}  // namespace duet
