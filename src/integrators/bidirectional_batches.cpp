#include "integrators/bidirectional_batches.h"

#include "integrators/tile_work.h"

namespace duet {

bool BidirectionalIntegrator::may_take_batches() const {
  return path_batches_ == PathBatches::where_possible && only_colours() && max_depth_ > 0 &&
         (options_.method == Method::bdpt || options_.method == Method::vcm) &&
         options_.connections <= 0;
}

bool BidirectionalIntegrator::takes_batches(const Scene& scene) const {
  return may_take_batches() && !scene.needs_media_vertices() &&
         suits_batches(scene, options_.hide_emitters, options_.strict_normals);
}

std::unique_ptr<BidirectionalIntegrator::Batches> BidirectionalIntegrator::make_batches(
    const Scene& scene) const {
  PathLimits limits;
  limits.max_depth = max_depth_, limits.rr_depth = options_.rr_depth;
  return std::make_unique<Batches>(scene, limits, options_.method == Method::vcm);
}

void BidirectionalIntegrator::trace_batches(Film& film, const SampleRange& samples,
                                            const PassControl& control, RenderCounters& counters) {
  batches_->plan = {set_,   key_,  pilot_->roulette_threshold(), &lights_, &sharing_, guide_.get(),
                    &grid_, &mask_};
  for_each_tile(film, samples, control, TileSplit::by_samples, counters,
                [&](FilmTile& tile, const TileSamples& part, RenderCounters& c) {
                  batches_->tiles.render(film, tile, samples, part, c);
                });
}

}  // namespace duet
