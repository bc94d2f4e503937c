#include "integrators/bidirectional_batches.h"

#include "integrators/tile_work.h"

namespace duet {

bool BidirectionalIntegrator::may_take_batches() const {
  return path_batches_ == PathBatches::where_possible && max_depth_ > 0 &&
         (options_.method != Method::reuse || is_thesis_);
}

bool BidirectionalIntegrator::may_take_eye_batches() const {
  return may_take_batches() && only_colours() &&
         (options_.method == Method::bdpt || options_.method == Method::vcm);
}

bool BidirectionalIntegrator::takes_groups(const Scene& scene) const {
  return may_take_eye_batches() && options_.connections <= 0 && takes_batches(scene);
}

bool BidirectionalIntegrator::takes_batches(const Scene& scene) const {
  return may_take_batches() && !scene.needs_media_vertices() && suits_batches(scene);
}

std::unique_ptr<BidirectionalIntegrator::Batches> BidirectionalIntegrator::make_batches(
    const Scene& scene) const {
  if (!takes_batches(scene)) return nullptr;
  auto batches =
      std::make_unique<Batches>(scene, blurs() ? WideUse::merging : WideUse::connections);
  PathLimits limits;
  limits.max_depth = max_depth_, limits.rr_depth = options_.rr_depth;
  limits.hide_emitters = options_.hide_emitters, limits.strict_normals = options_.strict_normals;
  if (may_take_eye_batches()) batches->begin_eye(*this, limits);
  return batches;
}

void BidirectionalIntegrator::trace_batches(Film& film, const SampleRange& samples,
                                            const PassControl& control, RenderCounters& counters) {
  batches_->plan = {set_,     key_,      pilot_->roulette_threshold(),
                    &lights_, &sharing_, guide_.get(),
                    &grid_,   &mask_,    options_.connections > 0 ? &drawn_ : nullptr};
  for_each_tile(film, samples, control, TileSplit::by_samples, counters,
                [&](FilmTile& tile, const TileSamples& part, RenderCounters& c) {
                  batches_->eye->render(film, tile, samples, part, c);
                });
}

}  // namespace duet
