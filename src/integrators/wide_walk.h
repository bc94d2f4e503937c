// What batches of paths from the camera do at their vertices, whatever they estimate there.
#pragma once

#include "integrators/camera_integrator.h"
#include "integrators/wide_gaps.h"
#include "integrators/wide_glossy.h"
#include "integrators/wide_kernels.h"
#include "integrators/wide_scene.h"
#include "scene/path_limits.h"

namespace duet {

/// What the samples of a batch have gathered, by the numbers of their pixels.
struct WideSamples {
  BatchArray<float> r, g, b, alpha;

  void add(int id, const Spectrum& s) { r[id] += s.r, g[id] += s.g, b[id] += s.b; }
};

/// Traces batches of paths from the camera for one thread; see WideTiles. What is rare goes through
/// the code for one path within the same stages: surfaces that are no plain meshes, materials that
/// have no loop of their own, lights that are not flat.
/// Source: Laine et al., "Megakernels Considered Harmful: Wavefront Path Tracing on GPUs", 2013;
/// Lee et al., "Vectorized Production Path Tracing", 2017.
class WideWalk {
 public:
  virtual ~WideWalk() = default;

  /// Where paths begin: set by the caller, who fills ray, from, throughput, id and keys.
  WidePaths& paths() { return paths_; }
  /// Says which pixels (y · width + x of the full image) the next batches have, by their ids.
  virtual void enter(std::span<const uint64_t>) {}
  /// Traces the first `n` paths to their ends and adds what they find to `samples`.
  virtual void trace(int n, const BatchSampler& sampler, WideSamples& samples,
                     RenderCounters& counters) = 0;

 protected:
  WideWalk(const WideScene& scene, const PathLimits& limits)
      : wide_(scene), limits_(limits), glossy_points_(scene.glossy.size()) {}

  void find_points(int n);
  /// Later than find_points(), when what was prefetched has arrived.
  void look_up_textures();
  void draw_numbers(int n, const BatchSampler& sampler, int depth);
  /// At points of glossy materials, the values for the light samples; and where not null, the
  /// reverse densities.
  void evaluate_glossy_points(BatchArray<float>* reverse);
  /// From there, the next directions; likewise.
  void sample_glossy_points(BatchArray<float>* reverse);
  /// Samples a BSDF at a point that has no loop of its own; the sample is empty if the path ends.
  std::optional<BsdfSample> scatter_at(int i, const Bsdf& bsdf);
  bool has_roulette(int depth) const { return depth >= limits_.rr_depth; }
  Hit hit(int i) const {
    return {hits_.t[i],         hits_.u[i],     hits_.v[i],
            hits_.primitive[i], hits_.shape[i], hits_.instance[i]};
  }
  Spectrum throughput(int i) const {
    return {paths_.throughput.x[i], paths_.throughput.y[i], paths_.throughput.z[i]};
  }
  /// Tests the first `n` shadow rays, of which some are blocked already, and adds what the others
  /// contribute. Returns how many rays there were and how many of them met nothing.
  struct Tested {
    int rays, lit;
  };
  Tested test_shadows(int n, WideShadowRays& rays, WideSamples& samples);

  const WideScene& wide_;
  PathLimits limits_;
  WidePaths paths_{};
  HitBatch hits_{};
  WidePoints points_{};
  WideNumbers numbers_{};
  WideLightChoice choice_{};
  WideLightSamples lights_{};
  WideShadowRays shadows_{};
  WideScattering scattering_{};
  WideGaps gaps_;
  std::vector<int> emitting_;                    ///< numbers of points on lights
  std::vector<std::vector<int>> glossy_points_;  ///< by WideShape::glossy
  bool has_glossy_points_ = false;
  WideGlossy glossy_{};
  /// Numbers of the points that Scene::surface() makes, and those surfaces.
  std::vector<int> special_;
  std::vector<Surface> surfaces_;

 private:
  /// Calls `f(count, material)` for the glossy points of each material, whose numbers stand in
  /// `glossy_` then.
  template <class F>
  void for_each_glossy(F&& f);
  void fetch(int n);
  void prefetch_textures();
  void set_reflectance(int i, const Spectrum& r) { points_.reflectance.set(i, r.r, r.g, r.b); }

  WideTriangles triangles_{};
  std::vector<int> textured_;
  std::vector<Surface> textured_points_;  ///< of `textured_`
};

}  // namespace duet
