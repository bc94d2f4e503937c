#include "integrators/wide_lights.h"

#include "base/instruction_sets.h"
#include "lights/area.h"
#include "transport/light_choice.h"

namespace duet {

namespace {

constexpr int kFlatNumbers = sizeof(FlatLight) / sizeof(float);
static_assert(kFlatNumbers == 17);

/// Gathers what stands in memory as a FlatLight from `f` on: compilers make
/// gathers of 32-bit numbers of elements, not of addresses.
[[gnu::always_inline]] inline FlatLight flat_light_at(const float* f, int i) {
  FlatLight l;
  l.origin = Point3f(f[i], f[i + 1], f[i + 2]);
  l.edge_u = Vector3f(f[i + 3], f[i + 4], f[i + 5]);
  l.edge_v = Vector3f(f[i + 6], f[i + 7], f[i + 8]);
  l.normal = Normal3f(f[i + 9], f[i + 10], f[i + 11]);
  l.radiance = Spectrum(f[i + 12], f[i + 13], f[i + 14]);
  l.area = f[i + 15];
  l.round = f[i + 16];
  return l;
}

[[gnu::always_inline]] inline void set_sample(int i, const FlatLight& l, const FlatLight::Sample& s,
                                              float probability, WideLightSamples& samples) {
  samples.wi.set(i, s.wi);
  samples.target.set(i, s.target);
  samples.weight.set(i, l.radiance.r * s.solid_angle, l.radiance.g * s.solid_angle,
                     l.radiance.b * s.solid_angle);
  samples.pdf[i] = s.facing > 0 ? s.pdf * probability : -1.0f;
  samples.probability[i] = probability;
  samples.finite[i] = 1;
  samples.delta[i] = 0;
}

DUET_WIDEST void sample_only_light(int n, const FlatLight& light, const WidePoints& points,
                                   const WideNumbers& numbers, WideLightSamples& samples) {
  const FlatLight l = light;
  DUET_LANES
  for (int i = 0; i < n; ++i)
    set_sample(i, l,
               l.sample_at(points.position.point(i), {numbers.light_x[i], numbers.light_y[i]}), 1,
               samples);
}

template <bool kRound>
[[gnu::always_inline]] inline void sample_flat(int n, const float* lights, const WidePoints& points,
                                               const WideNumbers& numbers,
                                               const LightChoices& choice,
                                               WideLightSamples& samples) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const FlatLight l = flat_light_at(lights, int32_t(choice.light[i]) * kFlatNumbers);
    float x = numbers.light_x[i], y = numbers.light_y[i];
    if constexpr (kRound) {
      const Point2f disk = square_to_disk({x, y});
      x = l.round > 0 ? disk.x : x, y = l.round > 0 ? disk.y : y;
    }
    set_sample(i, l, l.sample_at(points.position.point(i), {x, y}), choice.probability[i], samples);
  }
}

DUET_WIDEST void sample_parallelograms(int n, const float* lights, const WidePoints& points,
                                       const WideNumbers& numbers, const LightChoices& choice,
                                       WideLightSamples& samples) {
  sample_flat<false>(n, lights, points, numbers, choice, samples);
}

DUET_WIDEST void sample_flat_lights(int n, const float* lights, const WidePoints& points,
                                    const WideNumbers& numbers, const LightChoices& choice,
                                    WideLightSamples& samples) {
  sample_flat<true>(n, lights, points, numbers, choice, samples);
}

constexpr int kSphereNumbers = sizeof(SphereLight) / sizeof(float);
static_assert(kSphereNumbers == 9);

[[gnu::always_inline]] inline SphereLight sphere_at(const float* f, int i) {
  SphereLight l;
  l.center = Point3f(f[i], f[i + 1], f[i + 2]);
  l.radius = f[i + 3];
  l.radiance = Spectrum(f[i + 4], f[i + 5], f[i + 6]);
  l.offset = f[i + 7];
  l.emission = f[i + 8];
  return l;
}

DUET_WIDEST void sample_listed(int n, const float* lights, const WidePoints& points,
                               const WideNumbers& numbers, const LightChoices& choice,
                               ListedLightSamples& out) {
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const SphereLight l = sphere_at(lights, int32_t(choice.light[i]) * kSphereNumbers);
    const SphereLight::Sample s =
        l.sample(points.position.point(i), {numbers.light_x[i], numbers.light_y[i]});
    out.set(k, s.wi, s.target(l), l.radiance, s.pdf);
  }
}

void set_sample(int i, const std::optional<LightSample>& sample, float probability,
                WideLightSamples& samples) {
  samples.pdf[i] = -1;
  if (!sample) return;
  samples.wi.set(i, sample->wi);
  samples.target.set(i, sample->target);
  samples.weight.set(i, sample->weight.r, sample->weight.g, sample->weight.b);
  samples.pdf[i] = sample->pdf.value * probability;
  samples.probability[i] = probability;
  samples.finite[i] = sample->finite;
  samples.delta[i] = sample->delta;
  samples.emission[i] = sample->emission;
}

}  // namespace

WideLights::WideLights(const Scene& scene) : scene_(scene) {
  for (const auto& light : scene.lights) {
    const auto* flat =
        light->kind() == LightKind::area ? static_cast<const AreaLight&>(*light).flat() : nullptr;
    flat_.push_back(flat ? *flat : FlatLight{});
    has_flat_ |= flat != nullptr;
    has_round_ |= flat && flat->round > 0;
    const auto* sphere =
        light->kind() == LightKind::area ? static_cast<const AreaLight&>(*light).sphere() : nullptr;
    spheres_.push_back(sphere ? *sphere : SphereLight{});
    has_spheres_ |= sphere != nullptr;
    meshes_.add(*light);
  }
  if (flat_.size() == 1 && has_flat_ && !has_round_) only_ = flat_.data();
}

void WideLights::choose(int n, const WidePoints& points, const WideNumbers& numbers,
                        LightChoices& choices) const {
  if (has_light_choice(scene_))
    return scene_.direct_picker.pick(n, {numbers.light_choice, numbers.light_x, numbers.light_y},
                                     points.position, choices);
  std::fill_n(choices.light.begin(), n, 0u);
  std::fill_n(choices.probability.begin(), n, 1.0f);
}

void WideLights::sample(int n, const WidePoints& points, const WideNumbers& numbers,
                        LightChoices& choice, WideLightSamples& samples) const {
  if (only_) return sample_only_light(n, *only_, points, numbers, samples);
  if (flat_.empty()) {
    for (int i = 0; i < n; ++i) samples.pdf[i] = -1;
    return;
  }
  choose(n, points, numbers, choice);
  if (has_flat_)
    (has_round_ ? sample_flat_lights : sample_parallelograms)(n, &flat_.data()->origin.x, points,
                                                              numbers, choice, samples);
  if (has_spheres_) sample_spheres(n, points, numbers, choice, samples);
  meshes_.sample(n, points, numbers, choice, samples);
  for (int i = 0; i < n; ++i) {
    const uint32_t light = choice.light[i];
    if (flat_[light].area > 0 || spheres_[light].radius > 0 || meshes_.has(light)) continue;
    set_sample(i,
               scene_.lights[light]->sample_direct(points.position.point(i),
                                                   {numbers.light_x[i], numbers.light_y[i]}),
               choice.probability[i], samples);
  }
}

void WideLights::sample_spheres(int n, const WidePoints& points, const WideNumbers& numbers,
                                const LightChoices& choice, WideLightSamples& samples) const {
  ListedLightSamples spheres;
  int count = 0;
  for (int i = 0; i < n; ++i) {
    spheres.at[count] = i;
    count += spheres_[choice.light[i]].radius > 0;
  }
  sample_listed(count, &spheres_.data()->center.x, points, numbers, choice, spheres);
  for (int k = 0; k < count; ++k)
    spheres.copy(k, spheres_[choice.light[spheres.at[k]]].emission, choice, samples);
}

void WideLights::find_emission(int n, const LightStarts& starts, const WidePoints& points,
                               const LightChoices& choice, WideLightSamples& samples) const {
  for (int i = 0; i < n; ++i) {
    if (samples.pdf[i] < 0) continue;
    const uint32_t light = only_ ? 0 : choice.light[i];
    const float area = flat_[light].area;
    samples.emission[i] = starts.density(light, area > 0 ? kInvPi / area : samples.emission[i],
                                         samples.wi.vector(i), points.position.point(i));
  }
}

}  // namespace duet
