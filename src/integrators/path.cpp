#include "integrators/path.h"

#include "integrators/camera_samples.h"
#include "lights/area.h"

namespace duet {

namespace {

/// Random numbers that one vertex may use: choice and direction of the light, lobe and direction of
/// the BSDF, roulette.
constexpr uint32_t kDimensionsPerVertex = 8;

/// Weight of a sample with density a against one with density b (power heuristic, exponent 2).
float mis_weight(PdfW a, PdfW b) {
  if (!(a.value > 0)) return 0;
  const float ratio = b.value / a.value;
  return 1 / (1 + ratio * ratio);
}

struct PathState {
  const Scene& scene;
  const PathOptions& options;
  Sampler& sampler;
  RenderCounters& counters;
};

/// Light that arrives straight from a light at a vertex, weighted against BSDF sampling.
Spectrum sample_light(const PathState& p, const Surface& s, const Bsdf& bsdf) {
  const Point2f u = p.sampler.next_2d();
  const LightPicker::Pick pick = p.scene.picker.size() == 1
                                     ? LightPicker::Pick{0, 1}
                                     : p.scene.picker.pick(p.sampler.next_1d());
  const Light& chosen = *p.scene.lights[pick.light];
  const auto light = chosen.kind() == LightKind::area
                         ? static_cast<const AreaLight&>(chosen).sample_direct(s.position, u)
                         : chosen.sample_direct(s.position, u);
  if (!light) return {};
  if (p.options.strict_normals && dot(s.ng, light->wi) * dot(s.shading.n, light->wi) <= 0)
    return {};
  const BsdfEval f = bsdf.eval(light->wi, Transport::radiance);
  if (f.value.is_black()) return {};
  const Ray shadow = light->finite ? spawn_ray_to(s, light->target) : spawn_ray(s, light->wi);
  ++p.counters.shadow_rays;
  if (p.scene.accel->occluded(shadow)) return {};
  const float weight =
      light->delta ? 1.0f : mis_weight(PdfW{light->pdf.value * pick.probability}, f.pdf);
  return f.value * light->weight * (weight / pick.probability);
}

/// Radiance along `ray` and the coverage of its pixel.
Spectrum trace(const PathState& p, Ray ray, float& alpha) {
  const Scene& scene = p.scene;
  Spectrum radiance, throughput(1);
  PdfW bsdf_pdf;
  bool delta = true;   // the last direction could not have been found by light sampling
  bool passed = true;  // only null interfaces so far
  float eta = 1;
  Point3f from = ray.origin;
  for (int depth = 1;; ++depth) {
    Hit hit;
    ++p.counters.closest_rays;
    if (!scene.accel->closest_hit(ray, hit)) {
      if (scene.environment && !(p.options.hide_emitters && passed)) {
        const PdfW light_pdf = delta ? PdfW{}
                                     : PdfW{scene.environment->pdf_direct(ray.direction).value *
                                            scene.picker.probability(scene.environment_index)};
        const float w = delta ? 1.0f : mis_weight(bsdf_pdf, light_pdf);
        radiance += throughput * scene.environment->emitted(ray.direction) * w;
      }
      break;
    }
    ++p.counters.path_vertices;
    const Surface s = scene.surface(ray, hit);
    if (const SurfaceLight* light = scene.light_on(*s.shape);
        light && !(p.options.hide_emitters && passed)) {
      const Spectrum emitted = light->emitted(s, -ray.direction);
      if (!emitted.is_black()) {
        float w = 1;
        if (!delta) {
          const PdfW pdf = light->pdf_direct(from, s, ray.direction, hit.t * hit.t);
          w = mis_weight(bsdf_pdf, PdfW{pdf.value * scene.picker.probability(s.shape->light)});
        }
        radiance += throughput * emitted * w;
      }
    }
    if (p.options.max_depth >= 0 && depth >= p.options.max_depth) {
      alpha = 1;
      break;
    }
    const Bsdf bsdf = scene.materials[s.shape->material]->bind(s, -ray.direction);
    p.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1));
    if (bsdf.has_smooth() && scene.picker.size() > 0)
      radiance += throughput * sample_light(p, s, bsdf);
    p.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1) +
                              4);
    const Point2f v = p.sampler.next_2d();
    const float u = bsdf.needs_choice() ? p.sampler.next_1d() : 0.5f;
    const auto sample = bsdf.sample(u, v, Transport::radiance);
    if (!sample || !sample->null) alpha = 1;
    if (!sample) break;
    if (p.options.strict_normals && dot(s.ng, sample->wi) * dot(s.shading.n, sample->wi) <= 0)
      break;
    throughput *= sample->weight;
    eta *= sample->eta;
    bsdf_pdf = sample->pdf;
    delta = sample->delta;
    passed &= sample->null;
    from = s.position;
    ray = spawn_ray(s, sample->wi);
    if (depth >= p.options.rr_depth) {
      const float survive = std::min(throughput.max() * eta * eta, 0.95f);
      if (!(p.sampler.next_1d() < survive)) break;
      throughput *= 1 / survive;
    } else if (!(throughput.max() > 0)) {
      break;
    }
  }
  return radiance;
}

}  // namespace

void PathIntegrator::render_tile(const Scene& scene, const Film& film, FilmTile& tile,
                                 const SampleRange& samples, RenderCounters& counters) const {
  for_each_camera_sample(scene, film, tile, samples, counters,
                         [&](const Ray& ray, Sampler& sampler, std::span<float> values) {
                           if (options_.max_depth == 0) return;
                           const PathState state{scene, options_, sampler, counters};
                           const Spectrum l = trace(state, ray, values[3]);
                           values[0] = l.r, values[1] = l.g, values[2] = l.b;
                         });
}

}  // namespace duet
