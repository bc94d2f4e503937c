// What keeps many workers from sharing a render: its serial part, and workers without work at the
// end of a loop.
//
//   scaling SCENE.xml WIDTHxHEIGHT SPP WORKERS METHOD...
//
// Renders with each method on one thread as for so many workers. The program's loops over pieces of
// work run here one piece after the other, and the CPU time of each piece is taken: pieces are
// given to the worker that is free first, in their order, and the loop lasts as long as the last
// worker does. Prints the share of the CPU time outside of such loops, which is serial, and how
// many times as fast the workers are as one. What threads cost each other (locks, caches, memory,
// clock rates) is not in it. Exit code 1 if a serial share is 1 % or more.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <queue>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "cpu_time.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

using namespace duet;

namespace {

double thread_seconds() {
  return cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// The loops of a render: the CPU time of their pieces, and how long they last.
struct Loops {
  int workers = 1;
  int depth = 0;  ///< of loops in loops: the inner ones are part of a piece
  double work = 0, duration = 0;

  void run(size_t count, const std::function<void(size_t)>& piece) {
    if (++depth > 1) {
      for (size_t i = 0; i < count; ++i) piece(i);
    } else {
      std::priority_queue<double, std::vector<double>, std::greater<>> busy_until;
      for (int w = 0; w < workers; ++w) busy_until.push(0);
      double last = 0;
      for (size_t i = 0; i < count; ++i) {
        const double start = thread_seconds();
        piece(i);
        const double took = thread_seconds() - start, end = busy_until.top() + took;
        busy_until.pop();
        busy_until.push(end);
        last = std::max(last, end);
        work += took;
      }
      duration += last;
    }
    --depth;
  }
};

Loops loops;

bool measure(const std::string& method, const Scene& scene, IntegratorDescription description,
             const FilmLayout& layout, int spp) {
  apply_override(description, {method, {}, {}});
  const auto integrator = make_integrator(description);
  RenderRequest request;
  request.budget.spp = spp;
  request.threads = loops.workers;
  // One worker needs as many times as long for what they all do in a pass.
  request.pass_seconds *= loops.workers;
  loops.work = loops.duration = 0;
  const double start = thread_seconds(), others = cpu_seconds() - start;
  const RenderResult result = render(scene, *integrator, layout, request);
  const double total = thread_seconds() - start, serial = total - loops.work;
  if (cpu_seconds() - thread_seconds() - others > 0.001 * total) {
    fmt::print(stderr, "{}: other threads computed, so not all loops came here\n", method);
    return false;
  }
  fmt::print("{:>8}: {:6.2f} s, serial {:.2f} %, {:.1f} times as fast with {} workers\n", method,
             total, 100 * serial / total, total / (serial + loops.duration), loops.workers);
  return result.spp == spp && serial < 0.01 * total;
}

int run(int argc, char** argv) {
  int width = 0, height = 0;
  const int spp = argc > 3 ? std::atoi(argv[3]) : 0;
  loops.workers = argc > 4 ? std::atoi(argv[4]) : 0;
  if (argc < 6 || std::sscanf(argv[2], "%dx%d", &width, &height) != 2 || spp < 1 ||
      loops.workers < 1) {
    fmt::print(stderr, "usage: scaling SCENE.xml WIDTHxHEIGHT SPP WORKERS METHOD...\n");
    return 2;
  }
  Diagnostics diagnostics;
  auto file = read_mitsuba(argv[1], {}, diagnostics);
  std::unique_ptr<Scene> scene;
  IntegratorDescription integrator;
  FilmLayout layout;
  if (file) {
    FilmDescription& film = file->description.sensors.at(0).film;
    film.width = width, film.height = height;
    layout = {{width, height}, {0, 0, width, height}, film.filter};
    integrator = file->description.integrator;
    scene = build_scene(std::move(file->description), {}, diagnostics);
  }
  for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", d.to_string());
  if (!scene) return 1;
  bool good = true;
  for (int i = 5; i < argc; ++i) good = measure(argv[i], *scene, integrator, layout, spp) && good;
  return good ? 0 : 1;
}

}  // namespace

// The linker puts this in the place of duet::parallel_for (bench/CMakeLists.txt).
extern "C" void duet_scaling_parallel_for(size_t count, int,
                                          const std::function<void(size_t)>& work);
void duet_scaling_parallel_for(size_t count, int, const std::function<void(size_t)>& work) {
  loops.run(count, work);
}

int main(int argc, char** argv) {
  return run(argc, argv);
}
