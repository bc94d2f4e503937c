// The doorway to integrators: how a method of light transport fills a film.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/film.h"
#include "math/sampler.h"
#include "scene/scene.h"

namespace duet {

/// Samples first … first + count − 1 of every pixel, of one random sequence.
struct SampleRange {
  SampleSequence sequence = SampleSequence::sobol;
  uint64_t seed = 0;
  uint32_t scramble = 0;  ///< number of the batch; batches are independent
  uint32_t first = 0, count = 0;
};

/// What happened while rendering; summed over tiles.
struct RenderCounters {
  uint64_t closest_rays = 0, shadow_rays = 0;
  uint64_t camera_paths = 0, light_paths = 0;
  uint64_t path_vertices = 0;
  uint64_t nonfinite_samples = 0;

  void add(const RenderCounters& o) {
    closest_rays += o.closest_rays;
    shadow_rays += o.shadow_rays;
    camera_paths += o.camera_paths;
    light_paths += o.light_paths;
    path_vertices += o.path_vertices;
    nonfinite_samples += o.nonfinite_samples;
  }
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Names of the film channels that render_tile() fills, in order.
  virtual std::vector<std::string> channels() const = 0;
  /// Turns what the film has summed up into what its channels are called, once `spp` samples per
  /// pixel are there.
  virtual void finish(Image& image, int spp) const = 0;
  /// Adds samples to one tile. Called from many threads, never twice at a time for one tile.
  virtual void render_tile(const Scene& scene, const Film& film, FilmTile& tile,
                           const SampleRange& samples, RenderCounters& counters) const = 0;
};

}  // namespace duet
