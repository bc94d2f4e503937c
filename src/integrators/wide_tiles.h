// The film's tiles, rendered by batches of paths.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "integrators/wide_tracer.h"

namespace duet {

/// Renders tiles, from any thread. A batch holds one sample of each pixel of the tile's square in
/// the full image, also of those that a window cuts off: so a sample has the same company, and the
/// same bits, in every window, and however samples are divided into passes.
class WideTiles {
 public:
  /// `film` and `range` must outlive this, as must the scene, which stands still.
  WideTiles(const Scene& scene, const PathLimits& limits, const Film& film,
            const SampleRange& range);
  ~WideTiles();

  void render(FilmTile& tile, const TileSamples& samples, RenderCounters& counters);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> take_workspace();

  WideScene wide_;
  PathLimits limits_;
  const Film& film_;
  const SampleRange& range_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;  ///< those that no thread uses
};

}  // namespace duet
