// The loop over pixels and samples that all methods which start at the camera share.
#pragma once

#include "integrators/integrator.h"
#include "integrators/layers.h"

namespace duet {

/// Dimensions of the sampler: two for the film, two for the lens, then those of the method.
inline constexpr uint32_t kLensDimension = 2;
inline constexpr uint32_t kFirstVertexDimension = 4;

/// Layers that a method renders beside (or, without `image`, instead of) its colours.
struct CameraOutput {
  bool image = true;
  std::vector<Layer> layers;
};

/// A method that estimates the radiance along one camera ray at a time.
class CameraIntegrator : public Integrator {
 public:
  explicit CameraIntegrator(const CameraOutput& output);

  std::vector<std::string> channels() const final { return channels_; }
  void render_tile(const Scene& scene, const Film& film, FilmTile& tile, const SampleRange& samples,
                   RenderCounters& counters) const final;
  void finish(Image& image, int spp) const final;

 protected:
  /// An estimate of the radiance that arrives along `ray`. `alpha` becomes 1 if something is seen.
  virtual Spectrum radiance(const Scene& scene, const Ray& ray, Sampler& sampler,
                            RenderCounters& counters, float& alpha) const = 0;

 private:
  void sample(const Scene& scene, const Ray& ray, Sampler& sampler, RenderCounters& counters,
              std::span<float> values) const;

  struct PlacedLayer {
    LayerKind kind;
    size_t first;  ///< index of its first channel
  };
  bool image_;
  std::vector<PlacedLayer> layers_;
  std::vector<std::string> channels_;
  bool looks_at_first_hit_ = false;
};

}  // namespace duet
