#include "integrators/path.h"

#include <algorithm>

#include "base/failures.h"
#include "integrators/next_event.h"
#include "integrators/tile_work.h"
#include "integrators/wide_tiles.h"
#include "integrators/wide_tracer.h"
#include "materials/plain_diffuse.h"
#include "transport/roulette.h"

namespace duet {

/// A path that grows, and what it has found.
struct PathIntegrator::Path {
  Ray ray;  ///< to the next vertex
  Sampler& sampler;
  RenderCounters& counters;
  float& alpha;
  Spectrum sum{}, throughput{1};
  std::optional<PdfW> bsdf_pdf{};  ///< of the ray, if light samples compete with it
  Point3f from = ray.origin;       ///< the previous vertex
  float eta = 1;                   ///< relative index of refraction along the path
};

/// Whether some surface points are lit beside themselves, which batches do not know.
static bool has_shapes_lit_beside(const Scene& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                     [&](const Shape& s) { return is_lit_beside(scene, s); });
}

bool PathIntegrator::takes_batches(const Scene& scene) const {
  return batches_ == PathBatches::where_possible && only_colours() && options_.max_depth != 0 &&
         !options_.only_specular && suits_groups(scene);
}

bool PathIntegrator::suits_groups(const Scene& scene) {
  return suits_batches(scene) && !has_shapes_lit_beside(scene);
}

void PathIntegrator::choose(const Scene& scene, const RenderOutlook&) {
  if (options_.pixel_group > 1 && !takes_batches(scene))
    throw SceneFailure(
        "\"pixel_group\" of the integrator \"path\" is for scenes whose paths are traced in "
        "batches: not "
        "where something moves, with opaque ribbons, \"only_specular\" or a \"max_depth\" of 0");
}

void PathIntegrator::render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                                    const PassControl& control, RenderCounters& counters) {
  if (!takes_batches(scene))
    return CameraIntegrator::render_samples(scene, film, samples, control, counters);
  const WideScene wide_scene(scene, WideUse::paths);
  WideTiles wide(scene, *this, [&] { return std::make_unique<WideTracer>(wide_scene, options_); });
  for_each_tile(film, samples, control, TileSplit::by_samples, counters,
                [&](FilmTile& tile, const TileSamples& part, RenderCounters& c) {
                  wide.render(film, tile, samples, part, c);
                });
}

Spectrum PathIntegrator::radiance(const Scene& scene, const CameraPath& start, Sampler& sampler,
                                  RenderCounters& counters, std::span<float> values) const {
  if (options_.max_depth == 0) return {};
  Path path{options_.hide_emitters ? behind_emitters(scene, start.ray, counters) : start.ray,
            sampler, counters, values[3]};
  for (int depth = 1;; ++depth) {
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(path.ray, hit)) {
      // Also behind surfaces that light passes straight: nothing else has made the path opaque.
      if (options_.hide_emitters && path.alpha == 0) break;
      path.sum += path.throughput *
                  weighted_environment(scene, path.from, path.ray.direction, path.bsdf_pdf, {});
      if (scene.environment) path.alpha = 1;
      break;
    }
    ++counters.path_vertices;
    const Surface s = scene.surface(path.ray, hit);
    if (s.shape->light != kNone)
      path.sum +=
          path.throughput *
          weighted_emission(scene, s, {path.from, path.ray.direction, hit.t}, path.bsdf_pdf, {});
    // Where the direction was no delta lobe's the light on it has been found, and is all of it.
    if (depth == options_.max_depth || (options_.only_specular && path.bsdf_pdf)) {
      path.alpha = 1;
      break;
    }
    const Material& material = *scene.materials[s.shape->material];
    const Vector3f wo = -path.ray.direction;
    const bool goes_on = PlainDiffuse::suits(material)
                             ? scatter(scene, s, PlainDiffuse(material, s, wo), depth, path)
                             : scatter(scene, s, material.bind(s, wo), depth, path);
    if (!goes_on) break;
  }
  return path.sum;
}

template <class B>
inline bool PathIntegrator::scatter(const Scene& scene, const Surface& s, const B& bsdf, int depth,
                                    Path& path) const {
  Sampler& sampler = path.sampler;
  const uint32_t dimension = kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1);
  if (bsdf.has_smooth() && !scene.lights.empty()) {
    sampler.start_dimension(dimension);
    path.sum += path.throughput *
                sample_light(scene, s, bsdf, {options_.strict_normals}, sampler, path.counters);
  }
  sampler.start_dimension(dimension + kScatteringDimension);
  const Point2f v = sampler.next_2d();
  const float u = bsdf.needs_choice() ? sampler.next_1d() : 0.5f;
  const auto sample = bsdf.sample(u, v, Transport::radiance);
  if (!sample || !sample->null) path.alpha = 1;
  if (!sample || (options_.strict_normals && sides_differ(s, sample->wi))) return false;
  path.throughput *= sample->weight;
  const float importance = path.throughput.max();
  if (!(importance > 0)) return false;
  path.eta *= sample->eta;
  if (depth >= options_.rr_depth) {
    // Where light is refracted into a denser medium its radiance grows without carrying more.
    const float survival =
        russian_roulette(kPathRoulette.at(depth), importance * path.eta * path.eta, sampler);
    if (survival == 0) return false;
    path.throughput *= 1 / survival;
  }
  if (sample->delta)
    path.bsdf_pdf.reset();
  else
    path.bsdf_pdf = sample->pdf;
  path.from = lit_point(scene, s);
  path.ray = spawn_ray(s, sample->wi);
  return true;
}

}  // namespace duet
