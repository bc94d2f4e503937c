#include "integrators/volpath.h"

#include <bit>

#include "integrators/next_event.h"
#include "materials/plain_diffuse.h"

namespace duet {

namespace {

/// Random numbers of the path as a whole: the colour channel, and the start of its RandomStream.
constexpr uint32_t kPathDimension = kFirstVertexDimension;
/// Those of the first stretch of the path between surfaces or points of scattering.
constexpr uint32_t kFirstDimension = kPathDimension + 4;

}  // namespace

struct VolumePathIntegrator::Path {
  Ray ray;  ///< to the next vertex
  const Medium* medium;
  Sampler& sampler;
  RenderCounters& counters;
  float& alpha;
  RandomStream random;
  SpectralWeights weights{};
  Spectrum sum{};
  bool competes = false;      ///< light samples could have made the ray's direction
  Point3f from = ray.origin;  ///< the last point of scattering
  int depth = 0;              ///< how often light has been scattered
  float eta = 1;              ///< relative index of refraction along the path

  /// Light that the ray has found, which a light sample makes with the density `light_pdf`.
  void add(const Spectrum& radiance, float light_pdf) {
    const Spectrum density = competes ? weights.pdf + weights.light * light_pdf : weights.pdf;
    sum += radiance * weights.value * (1 / density.mean());
  }
};

namespace {

/// Adds what a light sends along a shadow ray, of which `value` goes on towards the eye. `pdf` is
/// the density with which scattering would have sent the path to the light.
template <class Path>
inline void add_light(const Scene& scene, const ChosenLight& light, const ShadowRay& ray,
                      const Spectrum& value, PdfW pdf, Path& path) {
  SpectralWeights shadow;
  shadow.channel = path.weights.channel;
  if (!shadow_transmittance(scene, ray, path.random, shadow, path.counters)) return;
  const LightSample& s = *light.sample;
  // The weight has been divided by the density of the light's point, not by that of its choice.
  const float scattering = s.delta ? 0.0f : pdf.value / (s.pdf.value * light.probability);
  const Spectrum density = path.weights.pdf * (shadow.pdf * scattering + shadow.light);
  path.sum += path.weights.value * value * s.weight * shadow.value *
              (1 / (light.probability * density.mean()));
}

}  // namespace

Spectrum VolumePathIntegrator::radiance(const Scene& scene, const CameraPath& start,
                                        Sampler& sampler, RenderCounters& counters,
                                        std::span<float> values) const {
  if (options_.max_depth == 0) return {};
  sampler.start_dimension(kPathDimension);
  const float channel = sampler.next_1d();
  const Point2f seed = sampler.next_2d();
  Path path{options_.hide_emitters ? behind_emitters(scene, start.ray, counters) : start.ray,
            scene.camera_medium,
            sampler,
            counters,
            values[3],
            RandomStream(uint64_t(std::bit_cast<uint32_t>(seed.x)) << 32 |
                         std::bit_cast<uint32_t>(seed.y))};
  path.weights.channel = std::min(int(channel * 3), 2);
  for (uint32_t stretch = 0;; ++stretch) {
    const uint32_t dimension = kFirstDimension + kDimensionsPerVertex * stretch;
    Hit hit;
    ++counters.closest_rays;
    const bool found = scene.accel->closest_hit(path.ray, hit);
    if (const float t = cross_medium(found, hit, dimension, path); t < INFINITY) {
      path.alpha = 1;
      if (!scatter_in_medium(scene, path.ray.origin + path.ray.direction * t, dimension, path))
        break;
      continue;
    }
    if (!found) {
      if (!scene.environment || hides_lights(path.depth)) break;
      const Vector3f& w = path.ray.direction;
      path.add(scene.environment->emitted(path.from, w),
               path.competes ? choice_density(scene, path.from, w) : 0);
      path.alpha = 1;
      break;
    }
    if (!meet_surface(scene, hit, dimension, path)) break;
  }
  return path.sum;
}

float VolumePathIntegrator::cross_medium(bool found, const Hit& hit, uint32_t dimension,
                                         Path& path) const {
  if (!path.medium) return INFINITY;
  Ray segment = path.ray;
  if (found) segment.tmax = hit.t;
  path.sampler.start_dimension(dimension + kDistanceDimension);
  const RandomStream before = path.random;
  if (path.medium->emits() && !hides_lights(path.depth))
    path.sum += path.weights.mean_over_channels() * path.medium->emitted(segment, path.random);
  const float t =
      path.medium->sample_distance(segment, path.sampler.next_1d(), path.random, path.weights);
  path.counters.medium_steps += 1 + path.random.drawn_since(before);
  return t;
}

bool VolumePathIntegrator::meet_surface(const Scene& scene, const Hit& hit, uint32_t dimension,
                                        Path& path) const {
  ++path.counters.path_vertices;
  const Surface s = scene.surface(path.ray, hit);
  if (const SurfaceLight* light = scene.light_on(*s.shape); light && !hides_lights(path.depth)) {
    const Vector3f& w = path.ray.direction;
    const Spectrum emitted = light->emitted(s, -w);
    const Vector3f way = s.position - path.from;
    if (!emitted.is_black())
      path.add(emitted, path.competes
                            ? choice_density(scene, *light, path.from, s, w, length_squared(way))
                            : 0);
  }
  const Material& material = *scene.materials[s.shape->material];
  if (at_limit(path.depth + 1) && !material.passes_straight()) {
    path.alpha = 1;
    return false;
  }
  const Vector3f wo = -path.ray.direction;
  return PlainDiffuse::suits(material)
             ? scatter_at_surface(scene, s, PlainDiffuse(material, s, wo), dimension, path)
             : scatter_at_surface(scene, s, material.bind(s, wo), dimension, path);
}

bool VolumePathIntegrator::scatter_in_medium(const Scene& scene, const Point3f& p,
                                             uint32_t dimension, Path& path) const {
  if (at_limit(++path.depth)) return false;
  ++path.counters.path_vertices;
  const PhaseFunction& phase = path.medium->phase();
  const Vector3f wo = -path.ray.direction;
  if (!scene.lights.empty()) {
    path.sampler.start_dimension(dimension);
    if (const ChosenLight light = choose_light(scene, p, path.sampler); light.sample) {
      const LightSample& s = *light.sample;
      const PdfW f = phase.eval(p, wo, s.wi);
      const Ray ray = s.finite ? ray_to(p, s.target) : Ray{p, s.wi, INFINITY};
      if (f.value > 0) add_light(scene, light, {ray, path.medium}, Spectrum(f.value), f, path);
    }
  }
  path.sampler.start_dimension(dimension + kScatteringDimension);
  const Point2f v = path.sampler.next_2d();
  const PhaseSample sample = phase.sample(p, wo, path.sampler.next_1d(), v);
  if (!(sample.pdf.value > 0) || !survives(path, kMediaRoulette)) return false;
  path.weights.light = path.weights.pdf * (1 / sample.pdf.value);
  path.competes = true;
  path.from = p;
  path.ray = {p, sample.wi, INFINITY};
  return true;
}

template <class B>
inline bool VolumePathIntegrator::scatter_at_surface(const Scene& scene, const Surface& s,
                                                     const B& bsdf, uint32_t dimension,
                                                     Path& path) const {
  Sampler& sampler = path.sampler;
  const bool separates = s.shape->separates_media();
  if (bsdf.has_smooth() && !scene.lights.empty() && !at_limit(path.depth + 1)) {
    sampler.start_dimension(dimension);
    const ChosenLight light = choose_light(scene, lit_point(scene, s), sampler);
    if (light.sample && !(options_.strict_normals && sides_differ(s, light.sample->wi))) {
      const LightSample& l = *light.sample;
      const BsdfEval f = bsdf.eval(l.wi, Transport::radiance);
      if (!f.value.is_black()) {
        const Ray ray = l.finite ? ray_to(offset_position(s, l.wi), l.target) : spawn_ray(s, l.wi);
        const Medium* medium = separates ? scene.medium_beyond(s, l.wi) : path.medium;
        add_light(scene, light, {ray, medium}, f.value, f.pdf, path);
      }
    }
  }
  sampler.start_dimension(dimension + kScatteringDimension);
  const Point2f v = sampler.next_2d();
  const float u = bsdf.needs_choice() ? sampler.next_1d() : 0.5f;
  const auto sample = bsdf.sample(u, v, Transport::radiance);
  if (!sample || !sample->null) path.alpha = 1;
  if (!sample || (options_.strict_normals && sides_differ(s, sample->wi))) return false;
  path.weights.value *= sample->weight;
  path.eta *= sample->eta;
  if (!sample->null) {
    if (at_limit(++path.depth)) return false;
    path.competes = !sample->delta;
    if (path.competes) path.weights.light = path.weights.pdf * (1 / sample->pdf.value);
    path.from = lit_point(scene, s);
  }
  if (!survives(path, kPathRoulette)) return false;
  if (separates) path.medium = scene.medium_beyond(s, sample->wi);
  path.ray = spawn_ray(s, sample->wi);
  return true;
}

bool VolumePathIntegrator::survives(Path& path, const Roulette& roulette) const {
  const float importance = path.weights.mean_over_channels().max();
  if (!(importance > 0)) return false;
  if (path.depth < options_.rr_depth) return true;
  // Where light is refracted into a denser medium its radiance grows without carrying more.
  const float survival =
      russian_roulette(roulette.at(path.depth), importance * path.eta * path.eta, path.sampler);
  if (survival == 0) return false;
  path.weights.value *= 1 / survival;
  return true;
}

}  // namespace duet
