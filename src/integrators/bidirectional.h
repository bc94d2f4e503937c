// The methods that trace sub-paths from both ends.
#pragma once

#include <memory>
#include <optional>

#include "integrators/camera_integrator.h"
#include "integrators/pilot.h"
#include "integrators/technique_layers.h"
#include "scene/description_integrators.h"
#include "transport/drawn_vertices.h"
#include "transport/light_pass.h"
#include "transport/subpath_sharing.h"
#include "transport/vertex_grid.h"

namespace duet {

/// Light tracing, bidirectional path tracing, path reuse, photon mapping in its progressive and
/// bidirectional forms, and vertex connection and merging, told apart by their TechniqueSet. Every
/// sample per pixel is an iteration: first all light sub-paths, then an eye sub-path per pixel.
class BidirectionalIntegrator final : public CameraIntegrator {
 public:
  using Options = BidirectionalIntegratorDescription;
  BidirectionalIntegrator(const Options& options, const CameraOutput& output,
                          PathBatches batches = PathBatches::where_possible);
  ~BidirectionalIntegrator() override;

  std::string bias() const override;
  uint32_t most_phases(Point2i film) const override;
  bool blurs() const override;
  bool layers_tell_noise() const override { return false; }
  double memory_bytes(const FilmLayout& film) const override;
  void prepare(Film& film) const override;

 protected:
  void choose(const Scene& scene, const RenderOutlook& outlook) override;
  void render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                      const PassControl& control, RenderCounters& counters) override;
  Spectrum radiance(const Scene& scene, const CameraPath& path, Sampler& sampler,
                    RenderCounters& counters, std::span<float> values) const override;
  std::unique_ptr<PathWorkspace> make_workspace(const Scene& scene) const override;

 private:
  template <class Vertex>
  struct Eye;
  struct Batches;
  template <class Vertex, class Weights>
  class EyeSubpath;
  using Method = BidirectionalMethod;

  /// Of all iterations: what does not differ between them.
  LightPassPlan light_plan(Point2i film) const;
  void iteration(const Scene& scene, Film& film, const SampleRange& samples,
                 const PassControl& control, RenderCounters& counters);
  TechniqueSet techniques(Point2i film, uint32_t iteration) const;
  double radius(uint32_t iteration) const;
  uint32_t light_subpaths(Point2i film) const;
  bool has_technique(int s, int t) const;
  /// Whether sub-paths may be traced in batches, and whether those from the camera may.
  bool may_take_batches() const;
  bool may_take_eye_batches() const;
  bool takes_batches(const Scene& scene) const;
  bool takes_groups(const Scene& scene) const;
  /// Null if they are not in this scene.
  std::unique_ptr<Batches> make_batches(const Scene& scene) const;
  void trace_batches(Film& film, const SampleRange& samples, const PassControl& control,
                     RenderCounters& counters);
  void splat(Film& film, std::span<const LightSplat> splats, RenderCounters& counters) const;

  // bidirectional_eye.cpp, bidirectional_connect.h and bidirectional_thesis.cpp. `Vertex` is
  // PathVertex, or MediaVertex (needs_media_vertices()).
  template <class Vertex>
  Spectrum trace(const Scene& scene, const CameraPath& path, Sampler& sampler,
                 RenderCounters& counters, std::span<float> values) const;
  template <class Vertex, class Weights>
  void subpath(const Weights& weights, SubpathPdfs* pdfs, Eye<Vertex>& eye) const;
  template <class Vertex, class Weights>
  void connect(const Weights& weights, const Vertex& v, bool light_sample, Eye<Vertex>& eye) const;
  /// Whether the method takes a light sample at a vertex to which `subpath` has come. Those that
  /// leave light to photons do so only for what is scattered by nearly specular lobes.
  template <class Vertex>
  bool samples_light(const Vertex& v, const Subpath& subpath) const;
  template <class Vertex, class Weights>
  void connect(const Weights& weights, const Vertex& v, Eye<Vertex>& eye) const;
  template <class Vertex, class Weights>
  void connect_to_cache(const Weights& weights, const Vertex& v, Eye<Vertex>& eye) const;
  template <class Vertex>
  void find_photons(const Vertex& v, Eye<Vertex>& eye) const;
  template <class Vertex, class Weights>
  void merge(const Weights& weights, const Vertex& v, Eye<Vertex>& eye) const;
  /// The light sub-path that `v` is connected with.
  template <class Vertex>
  size_t light_subpath(const Vertex& v, const Eye<Vertex>& eye) const;
  /// Its vertices that make no path too long with `v`, and those among them that cannot be
  /// connected.
  template <class Vertex>
  int candidates(const Vertex& v, const Eye<Vertex>& eye) const;
  /// Whether the method merges in a pixel, whose number is that of CameraPath.
  bool merges_in(uint64_t pixel) const;
  template <class Vertex>
  bool enter_tail(Subpath& subpath, Eye<Vertex>& eye) const;
  /// What the thesis does at the end of an eye sub-path that cannot connect.
  void thesis_tail(const PathVertex& limit, Subpath& subpath, Eye<PathVertex>& eye) const;
  template <class Vertex>
  void add(Eye<Vertex>& eye, int s, int t, const Connection& connection) const;

  Options options_;
  int max_depth_;
  bool is_thesis_;  ///< path reuse with the weights of the thesis
  bool raw_techniques_ = false;
  TechniqueLayers layers_;
  Windows windows_;
  MergeMask mask_;
  std::optional<Pilot> pilot_;
  PathBatches path_batches_;
  std::unique_ptr<Batches> batches_;  ///< of the call under way; null where they are not taken
  std::unique_ptr<const EmissionGuide> guide_;  ///< null where it would not help

  // Of the iteration under way.
  TechniqueSet set_;
  uint64_t key_ = 0;
  SubpathSharing sharing_;
  LightPass lights_;
  VertexGrid grid_;
  DrawnVertices drawn_;
};

std::unique_ptr<Integrator> make_bidirectional(const BidirectionalIntegratorDescription& d,
                                               const CameraOutput& output);

}  // namespace duet
