// What batches of paths do at their vertices, wherever they come from and whatever is estimated
// there.
#pragma once

#include "integrators/camera_integrator.h"
#include "integrators/wide_gaps.h"
#include "integrators/wide_glossy.h"
#include "integrators/wide_kernels.h"
#include "integrators/wide_scene.h"
#include "scene/path_limits.h"

namespace duet {

/// The stages of batches of paths that one thread traces. What is rare goes through the code for
/// one path within the same stages: surfaces that are no plain meshes, materials that have no loop
/// of their own, lights that are not flat. Source: Laine et al., "Megakernels Considered Harmful:
/// Wavefront Path Tracing on GPUs", 2013; Lee et al., "Vectorized Production Path Tracing", 2017.
class WideStages {
 protected:
  /// `transport` is what the paths carry.
  WideStages(const WideScene& scene, const PathLimits& limits, Transport transport)
      : wide_(scene),
        limits_(limits),
        transport_(transport),
        glossy_points_(scene.glossy.size()),
        specular_points_(scene.specular.size()) {}

  /// What the rays of all paths meet next.
  void trace_rays(int n, RenderCounters& counters);
  /// With hide_emitters the camera's rays, which have been traced, begin behind the emitters that
  /// they meet: behind_emitters().
  void pass_emitters(int n, RenderCounters& counters);
  void find_points(int n);
  /// Instead of that where paths end: only finds those of the points that emit.
  void find_emitting(int n);
  /// Later than find_points(), when what was prefetched has arrived. Points have the normals then
  /// that bump and normal maps give them.
  void look_up_textures();
  /// Random numbers of vertices of paths from the camera.
  void draw_numbers(int n, const BatchSampler& sampler, int depth);
  /// Those of scattering, which begin at a dimension.
  void draw_scattering(int n, const BatchSampler& sampler, uint32_t dimension, int depth);
  /// At points of glossy materials, the values for the directions of `lights_`; and where not null,
  /// the reverse densities.
  void evaluate_glossy_points(BatchArray<float>* reverse);
  /// From there, the next directions; likewise.
  void sample_glossy_points(BatchArray<float>* reverse);
  /// The same at points of specular materials.
  void sample_specular_points(BatchArray<float>* reverse);
  /// Before these and after look_up_textures(): which paths pass masks straight. The numbers of the
  /// others are those of what lies below then.
  void choose_at_masks();
  /// After these: what bump and normal maps do to light from directions of `lights_` and from the
  /// next ones, at points whose BSDFs lanes have in the frame of the perturbed normal. The normals
  /// of these are those of the surfaces again.
  void shade_perturbed_points();
  /// After that: what masks do to light from directions of `lights_` and to the next ones.
  void shade_masked_points();
  /// Samples a BSDF at a point that has no loop of its own; the sample is empty if the path ends.
  std::optional<BsdfSample> scatter_at(int i, const Bsdf& bsdf);
  /// With strict_normals: no light samples, or next directions, that the two normals of a point see
  /// on different sides.
  void drop_two_sided_light_samples(int n);
  void drop_two_sided_directions(int n);
  bool has_two_sides(int i, const Vector3f& w) const {
    return sides_differ(points_.ng.vector(i), points_.ns.vector(i), w);
  }
  bool has_roulette(int depth) const { return depth >= limits_.rr_depth; }
  /// Nothing where it has not begun.
  std::optional<Roulette> roulette_at(int depth, const Roulette& r) const {
    return has_roulette(depth) ? std::optional(r.at(depth)) : std::nullopt;
  }
  WideVertices vertices() const { return {paths_, points_, numbers_, transport_}; }
  Hit hit(int i) const {
    return {hits_.t[i],         hits_.u[i],     hits_.v[i],
            hits_.primitive[i], hits_.shape[i], hits_.instance[i]};
  }
  Spectrum throughput(int i) const { return color_at(paths_.throughput, i); }
  /// Plans how the gaps are closed that paths leave which have met nothing; returns how many stay.
  int find_hits(int n) {
    return gaps_.find(n, [&](int i) { return int(hits_.shape[i] != kNone); });
  }
  /// The same of those that end.
  int find_alive(int n) {
    return gaps_.find(n, [&](int i) { return scattering_.alive[i]; });
  }
  /// Tests the first `n` shadow rays, of which some are blocked already, and calls `sums.add(id,
  /// contribution)` for those that meet nothing. Returns how many rays there were and how many of
  /// them met nothing.
  struct Tested {
    int rays, lit;
  };
  template <class Sums>
  Tested test_shadows(int n, WideShadowRays& rays, Sums& sums) {
    return add_lit(find_unblocked(n, rays), rays, sums);
  }
  /// Moves the rays that nothing blocks yet to the front and tests them; returns how many.
  int find_unblocked(int n, WideShadowRays& rays);
  /// The same as test_shadows() of rays that find_unblocked() has left.
  template <class Sums>
  static Tested add_lit(int count, const WideShadowRays& rays, Sums& sums) {
    Tested tested{count, 0};
    for (int i = 0; i < tested.rays; ++i) {
      if (rays.blocked[i]) continue;
      ++tested.lit;
      sums.add(rays.id[i], color_at(rays.contribution, i));
    }
    return tested;
  }

  const WideScene& wide_;
  PathLimits limits_;
  const Transport transport_;
  WidePaths paths_{};
  HitBatch hits_{};
  WidePoints points_{};
  WideNumbers numbers_{};
  LightChoices choice_{};
  WideLightSamples lights_{};  ///< or, of sub-paths from the lights, samples of the lens
  WideShadowRays shadows_{};
  WideScattering scattering_{};
  WideGaps gaps_;
  std::vector<int> emitting_;  ///< numbers of points on lights
  using PointLists = std::vector<std::vector<int>>;
  PointLists glossy_points_, specular_points_;  ///< by WideShape::number
  bool has_listed_points_ = false;              ///< whether there are any of these
  WideGlossy glossy_{};
  /// Numbers of the points that Scene::surface() makes, and those surfaces.
  std::vector<int> special_;
  std::vector<Surface> surfaces_;

 private:
  /// Calls `f(count, material)` for the points of each material, whose numbers stand in `glossy_`
  /// then.
  template <class Material, class F>
  void for_each_material(const PointLists& points, const std::vector<Material>& materials, F&& f);
  void list_point(int i, const WideShape& shape);
  /// The k-th of what was sampled for those.
  void set_scattering(int k, BatchArray<float>* reverse);
  void fetch(int n);
  void prefetch_textures();
  void set_reflectance(int i, const Spectrum& r) { points_.reflectance.set(i, r.r, r.g, r.b); }

  void perturb_normals();

  /// A point below a bump or normal map, and where its surface is in `surfaces_`.
  struct PerturbedPoint {
    int point;
    size_t surface;
    Tilt tilt;
  };

  /// A point below a mask that is not opaque there.
  struct MaskedPoint {
    int point;
    float share;  ///< of what lies below
    bool passes;  ///< straight
  };

  void list_masked_points();

  WideTriangles triangles_{};
  std::vector<int> textured_;             ///< where something is looked up, but for `special_`
  std::vector<Surface> textured_points_;  ///< of `textured_`
  std::vector<PerturbedPoint> perturbed_;
  std::vector<MaskedPoint> masked_;
};

}  // namespace duet
