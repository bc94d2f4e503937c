// What adding splats to a film costs: it is to be in proportion to their number, however many
// queues they come from.
//
//     splats      prints processor time per splat; exit code 1 if it is eight times as much
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "cpu_time.h"
#include "image/film.h"
#include "math/hash.h"

using namespace duet;

namespace {

std::vector<Splat> make_splats(size_t count, Point2i film) {
  std::vector<Splat> splats;
  splats.reserve(count);
  for (uint32_t i = 0; i < count; ++i)
    splats.push_back({{to_unit_float(mix32(2 * i)) * float(film.x),
                       to_unit_float(mix32(2 * i + 1)) * float(film.y)},
                      Spectrum(1, 0.5f, 0.25f)});
  return splats;
}

/// Nanoseconds of processor time per splat: the least of three runs. Each queue is added by itself,
/// as a block of light sub-paths is.
double cost(size_t count, size_t queues, int threads, FilterKind kind) {
  FilmLayout layout{{512, 512}, {0, 0, 512, 512}, {}};
  layout.filter.kind = kind;
  const std::vector<Splat> splats = make_splats(count, layout.full);
  double least = 1e9;
  for (int run = 0; run < 3; ++run) {
    Film film(layout, {"R", "G", "B"});
    film.add_splat_layer(0);
    const double start = cpu_seconds();
    parallel_for(queues, threads, [&](size_t q) {
      const size_t first = count * q / queues, end = count * (q + 1) / queues;
      film.add_splats(0, std::span(splats).subspan(first, end - first), 1);
    });
    least = std::min(least, (cpu_seconds() - start) * 1e9 / double(count));
  }
  return least;
}

}  // namespace

int main() {
  bool is_linear = true;
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    fmt::print("{} filter, ns per splat:\n", kind == FilterKind::box ? "box" : "gaussian");
    double first = 0;
    for (const auto& [queues, threads] : {std::pair{1, 1}, {2, 2}, {64, 2}, {1024, 2}})
      for (const size_t count : {size_t(1) << 18, size_t(1) << 20, size_t(1) << 22}) {
        const double ns = cost(count, size_t(queues), threads, kind);
        if (first == 0) first = ns;
        // Few splats of a queue are in the same rows, whose sums then come from farther caches:
        // two to four times as much (EPYC, Zen 3). What went through all pixels would be hundreds.
        is_linear &= ns < 8 * first;
        fmt::print("  {:5} queues, {} threads, {:8} splats: {:6.1f}\n", queues, threads, count, ns);
      }
  }
  return is_linear ? 0 : 1;
}
