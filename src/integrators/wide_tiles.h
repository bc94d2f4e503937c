// The film's tiles, rendered by batches of paths.
#pragma once

#include <functional>

#include "base/object_pool.h"
#include "integrators/camera_integrator.h"
#include "integrators/wide_walk.h"

namespace duet {

/// Renders tiles, from any thread. A batch holds one sample of each pixel of the tile's square in
/// the full image, also of those that a window cuts off: so a sample has the same company, and the
/// same bits, in every window, and however samples are divided into passes.
class WideTiles {
 public:
  using MakeWalk = std::function<std::unique_ptr<WideWalk>()>;
  /// `make_walk` is called once for each thread at work. `method` adds its layers. Both it and the
  /// scene must outlive this.
  WideTiles(const Scene& scene, const CameraIntegrator& method, MakeWalk make_walk);
  ~WideTiles();

  /// Samples `range` but for the part of it, which `samples` says.
  void render(const Film& film, FilmTile& tile, const SampleRange& range,
              const TileSamples& samples, RenderCounters& counters);

 private:
  struct Workspace;

  const Scene& scene_;
  const CameraIntegrator& method_;
  MakeWalk make_walk_;
  ObjectPool<Workspace> workspaces_;
};

}  // namespace duet
