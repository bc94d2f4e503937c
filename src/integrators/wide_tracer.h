// Paths of many pixels at once, stage by stage.
#pragma once

#include "integrators/camera_integrator.h"
#include "integrators/wide_gaps.h"
#include "integrators/wide_glossy.h"
#include "integrators/wide_kernels.h"
#include "integrators/wide_scene.h"
#include "scene/description_integrators.h"

namespace duet {

/// What the samples of a batch have gathered, by the numbers of their pixels.
struct WideSamples {
  BatchArray<float> r, g, b, alpha;
};

/// Traces batches of paths from the camera for one thread, in the same way as PathIntegrator traces
/// one path: with the same random numbers every path is the same bit for bit, unless it meets two
/// surfaces that are equally near or, by rounding, the edge of one. What is rare goes through the
/// code for one path within the same stages: surfaces that are no plain meshes, materials other
/// than diffuse ones and usual rough plastics and conductors, lights that are not flat.
/// Source: Laine et al., "Megakernels Considered Harmful: Wavefront Path Tracing on GPUs", 2013;
/// Lee et al., "Vectorized Production Path Tracing", 2017.
class WideTracer {
 public:
  WideTracer(const WideScene& scene, const PathLimits& limits)
      : wide_(scene), limits_(limits), glossy_points_(scene.glossy.size()) {}

  /// Where paths begin: set by the caller, who fills ray, throughput, id and keys.
  WidePaths& paths() { return paths_; }
  /// Traces the first `n` paths to their ends and adds what they find to `samples`.
  void trace(int n, const BatchSampler& sampler, WideSamples& samples, RenderCounters& counters);

 private:
  /// Adds what those find that have left the scene; the rest is left in front.
  int end_outside(int n, WideSamples& samples);
  void find_points(int n);
  void fetch(int n);
  void prefetch_textures();
  /// Later, when what was prefetched has arrived.
  void look_up_textures();
  void set_reflectance(int i, const Spectrum& r) { points_.reflectance.set(i, r.r, r.g, r.b); }
  void add_emission(WideSamples& samples) const;
  void draw_numbers(int n, const BatchSampler& sampler, int depth);
  /// At points of glossy materials: the value for the light sample, and the next direction.
  void scatter_glossy();
  /// The same at points that the code for one path has to look at.
  void scatter_one_by_one();
  void add_light(int n, WideSamples& samples, RenderCounters& counters);
  int keep_alive(int n);
  bool has_roulette(int depth) const { return depth >= limits_.rr_depth; }

  std::optional<PdfW> bsdf_pdf(int i) const {
    return paths_.bsdf_pdf[i] < 0 ? std::nullopt : std::optional(PdfW{paths_.bsdf_pdf[i]});
  }
  Spectrum throughput(int i) const {
    return {paths_.throughput.x[i], paths_.throughput.y[i], paths_.throughput.z[i]};
  }

  const WideScene& wide_;
  PathLimits limits_;
  WidePaths paths_{};
  HitBatch hits_{};
  WideTriangles triangles_{};
  WidePoints points_{};
  WideNumbers numbers_{};
  WideLightChoice choice_{};
  WideLightSamples lights_{};
  WideShadowRays shadows_{};
  WideScattering scattering_{};
  WideGaps gaps_;
  std::vector<int> emitting_, textured_;
  std::vector<std::vector<int>> glossy_points_;  ///< by WideShape::glossy
  bool has_glossy_points_ = false;
  WideGlossy glossy_{};
  /// Numbers of the points that Scene::surface() makes, and those surfaces.
  std::vector<int> special_;
  std::vector<Surface> surfaces_;
  std::vector<Surface> textured_points_;  ///< of `textured_`
};

}  // namespace duet
