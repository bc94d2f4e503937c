// The loop over pixels and samples that all methods which start at the camera share.
#pragma once

#include "integrators/integrator.h"
#include "integrators/layers.h"

namespace duet {

/// Dimensions of the sampler: two for the film, two for the lens, then those of the method.
inline constexpr uint32_t kLensDimension = 2;
inline constexpr uint32_t kFirstVertexDimension = 4;
/// Those of each vertex: direction to and choice of the light; the distance from the last vertex
/// where there are media; direction and lobe of scattering, roulette.
inline constexpr uint32_t kDimensionsPerVertex = 8;
inline constexpr uint32_t kDistanceDimension = 3, kScatteringDimension = 4;

/// Whether a method traces paths in batches (wide_stages.h) or one by one. The images are the same,
/// to rounding.
enum class PathBatches { where_possible, never };

/// Whether each technique of a bidirectional method gets a layer of its own.
enum class TechniqueOutput {
  none,
  weighted,  ///< the layers add up to the image
  raw,       ///< each as if it were the only one
};

/// Layers that a method renders beside (or, without `image`, instead of) its colours.
struct CameraOutput {
  bool image = true;
  std::vector<Layer> layers;
  Transform frame;  ///< of layers in one: AovDescription::frame
  TechniqueOutput techniques = TechniqueOutput::none;
};

/// What a method needs to trace a path and keeps for the next one of the same tile.
struct PathWorkspace {
  virtual ~PathWorkspace() = default;
};

/// Where a path from the camera begins.
struct CameraPath {
  Ray ray;
  uint64_t pixel;    ///< y · width + x of the full image
  uint32_t sample;   ///< its number in the pixel
  float weight = 1;  ///< of the ray, by which the colours are multiplied; not zero
  /// Those beside it, if a layer needs them and the camera has any.
  const NextRays* next = nullptr;
  PathWorkspace* workspace = nullptr;  ///< what make_workspace() has made for the tile
};

/// A method that estimates the radiance along one camera ray at a time.
class CameraIntegrator : public Integrator {
 public:
  explicit CameraIntegrator(const CameraOutput& output);

  std::vector<std::string> channels() const final { return channels_; }
  std::vector<std::string> data_channels() const final;
  void prepare(Film& film) const override;
  /// Not if a layer tells how many samples there are, or needs to know.
  bool tiles_may_differ() const final;

  bool has_layers() const { return !layers_.empty(); }
  bool looks_at_next_rays() const { return looks_at_next_rays_; }
  /// Of a sample whose colours, and nothing else, are in `values`, the layers beside them. The
  /// sampler is at the sample.
  void add_layers(const Scene& scene, const CameraPath& path, Sampler& sampler,
                  RenderCounters& counters, std::span<float> values) const;

 protected:
  void render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                      const PassControl& control, RenderCounters& counters) override;
  /// An estimate of the radiance that arrives along the path's ray. `values` are the channels of
  /// the sample, all zero; the fourth, alpha, becomes 1 if something is seen. The first three are
  /// set by the caller.
  virtual Spectrum radiance(const Scene& scene, const CameraPath& path, Sampler& sampler,
                            RenderCounters& counters, std::span<float> values) const = 0;
  virtual std::unique_ptr<PathWorkspace> make_workspace(const Scene&) const { return nullptr; }
  /// Whether radiance() makes colours and alpha alone, which batches can do in its place.
  bool only_colours() const { return image_ && colour_layers_.empty(); }
  /// Adds a layer of three channels that radiance() fills; returns the first of them.
  size_t add_colour_layer(const std::string& name);
  /// Has the film gather the moments that layers ask for, which a sample cannot tell where passes
  /// also add splats.
  void gather_moments(Film& film) const;

 private:
  /// In two forms, so that neighbours cost nothing where no layer looks at them.
  template <bool kWithNextRays>
  void render_tile(const Scene& scene, const Film& film, FilmTile& tile, const SampleRange& samples,
                   RenderCounters& counters) const;
  void sample(const Scene& scene, const CameraPath& path, Sampler& sampler,
              RenderCounters& counters, std::span<float> values) const;

  struct PlacedLayer {
    LayerKind kind;
    size_t first;     ///< index of its first channel
    size_t channels;  ///< number of them
    bool in_frame;    ///< as AovDescription::Layer has it
  };
  bool image_;
  std::vector<PlacedLayer> layers_;
  Transform frame_;
  std::vector<std::string> channels_;
  std::vector<size_t> colour_layers_;  ///< where those of add_colour_layer() begin
  bool looks_at_first_hit_ = false, looks_at_next_rays_ = false, follows_specular_ = false;
};

}  // namespace duet
