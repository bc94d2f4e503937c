#include "integrators/integrator.h"

#include <algorithm>

#include "integrators/motion_blur.h"
#include "scene/scene_motion.h"

namespace duet {

SampleRange part_of(const SampleRange& range, uint32_t done, uint32_t count,
                    std::vector<TileSamples>& tiles) {
  SampleRange part = range;
  part.first = range.first + done;
  part.count = count;
  tiles.resize(range.tiles.size());
  for (size_t k = 0; k < tiles.size(); ++k) {
    const TileSamples& all = range.tiles[k];
    const uint32_t skipped = std::min(done, all.count);
    tiles[k] = {all.first + skipped, std::min(count, all.count - skipped)};
  }
  part.tiles = tiles;
  return part;
}

void Integrator::begin(const Scene& scene, const RenderOutlook& outlook) {
  const MotionLease lease(scene.motion.get());
  if (scene.motion) scene.motion->pose(0.5);
  choose(scene, outlook);
}

void Integrator::render_pass(const Scene& scene, Film& film, const SampleRange& samples,
                             const PassControl& control, RenderCounters& counters) {
  if (!scene.motion) return render_samples(scene, film, samples, control, counters);
  const MotionLease lease(scene.motion.get());
  if (!phases_) phases_ = std::make_shared<MotionPhases>();
  phases_->start(scene, film.full_size(), most_phases(film.full_size()), samples);
  for_each_pose(scene, *phases_, samples, control,
                [&](const SampleRange& some, const PassControl& part) {
                  render_samples(scene, film, some, part, counters);
                });
}

}  // namespace duet
