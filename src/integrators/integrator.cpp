#include "integrators/integrator.h"

#include <atomic>

#include "base/parallel.h"

namespace duet {

void for_each_tile(Film& film, const PassControl& control, RenderCounters& counters,
                   const std::function<void(FilmTile&, RenderCounters&)>& work) {
  std::vector<FilmTile>& tiles = film.tiles();
  std::vector<RenderCounters> of_tile(tiles.size());
  std::atomic<size_t> done{0};
  parallel_for(tiles.size(), control.threads, [&](size_t i) {
    if (control.cancelled()) return;
    work(tiles[i], of_tile[i]);
    control.report(double(++done) / double(tiles.size()));
  });
  for (const RenderCounters& c : of_tile) counters.add(c);
}

}  // namespace duet
