// The CPU time of one sample, without anything around it.
//
//   paths SCENE.xml WIDTHxHEIGHT SPP ROUNDS [METHOD] [independent] [singly] [NAME=VALUE...]
//
// Renders on one thread, several times in one process, and prints the least CPU time per path from
// the camera, and a hash of the image: by it two programs are seen to make the same one. `singly`
// has `path` trace its paths in batches and one by one, in turn, and prints the ratio, too.
#include <fmt/format.h>

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "cpu_time.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "integrators/path.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

namespace {

using namespace duet;

uint64_t hash_of(const Image& image) {
  uint64_t hash = 0;
  for (const float v : image.data) hash = hash_combine(hash, std::bit_cast<uint32_t>(v));
  return hash;
}

double mean_of(const Image& image) {
  double sum = 0;
  for (size_t i = 0; i < image.data.size(); ++i)
    if (i % image.channels.size() < 3) sum += double(image.data[i]);
  return sum / (3 * double(image.width) * image.height);
}

/// How many numbers of two images differ by more than rounding.
size_t differences(const Image& a, const Image& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.data.size(); ++i)
    count += std::abs(a.data[i] - b.data[i]) > 1e-4f * (1 + std::abs(b.data[i]));
  return count;
}

struct Options {
  int width = 0, height = 0, spp = 0, rounds = 0;
  std::string method;
  SampleSequence sequence = SampleSequence::sobol;
  bool singly = false;
  MitsubaOptions mitsuba;
};

bool read_options(int argc, char** argv, Options& o) {
  if (argc < 5 || std::sscanf(argv[2], "%dx%d", &o.width, &o.height) != 2) return false;
  o.spp = std::atoi(argv[3]), o.rounds = std::atoi(argv[4]);
  for (int i = 5; i < argc; ++i) {
    const std::string word = argv[i];
    if (const size_t equals = word.find('='); equals != std::string::npos)
      o.mitsuba.defines.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    else if (word == "independent")
      o.sequence = SampleSequence::independent;
    else if (word == "singly")
      o.singly = true;
    else
      o.method = word;
  }
  return o.spp > 0 && o.rounds > 0;
}

/// `path` with the scene's limits that traces one path at a time; null if the scene has another
/// method.
std::unique_ptr<Integrator> one_by_one(const IntegratorDescription& integrator) {
  const auto* path = std::get_if<PathIntegratorDescription>(&integrator.method);
  return path ? std::make_unique<PathIntegrator>(*path, CameraOutput{}, PathBatches::never)
              : nullptr;
}

/// The least CPU time of a path in microseconds, over rounds that take turns.
struct Timing {
  Integrator& integrator;
  double least = INFINITY;
  RenderResult result = {};

  void run(const Scene& scene, const FilmLayout& layout, const RenderRequest& request) {
    const double start = cpu_seconds();
    result = render(scene, integrator, layout, request);
    least = std::min(least, (cpu_seconds() - start) * 1e6 / double(result.counters.camera_paths));
  }
  void print() const {
    fmt::print("{:.4f} us per path, image {:016x}, mean {:.9g}\n", least, hash_of(result.image),
               mean_of(result.image));
  }
};

int run(int argc, char** argv) {
  Options o;
  if (!read_options(argc, argv, o)) {
    fmt::print(stderr,
               "usage: paths SCENE.xml WIDTHxHEIGHT SPP ROUNDS [METHOD] [independent] [singly] "
               "[NAME=VALUE...]\n");
    return 2;
  }
  Diagnostics diagnostics;
  auto file = read_mitsuba(argv[1], o.mitsuba, diagnostics);
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Integrator> integrator, singly;
  FilmLayout layout;
  if (file) {
    FilmDescription& film = file->description.sensors.at(0).film;
    film.width = o.width, film.height = o.height;
    layout = {{o.width, o.height}, {0, 0, o.width, o.height}, film.filter};
    if (!o.method.empty()) apply_override(file->description.integrator, {o.method, {}, {}});
    integrator = make_integrator(file->description.integrator);
    if (o.singly) singly = one_by_one(file->description.integrator);
    scene = build_scene(std::move(file->description), {}, diagnostics);
  }
  for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", d.to_string());
  if (!scene) return 1;
  RenderRequest request;
  request.budget.spp = o.spp;
  request.sequence = o.sequence;
  Timing batches{*integrator}, alone{singly ? *singly : *integrator};
  for (int i = 0; i < o.rounds; ++i) {
    batches.run(*scene, layout, request);
    if (singly) alone.run(*scene, layout, request);
  }
  batches.print();
  if (singly) {
    alone.print();
    fmt::print("one by one / in batches {:.3f}, {} of {} numbers differ\n",
               alone.least / batches.least, differences(batches.result.image, alone.result.image),
               alone.result.image.data.size());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv);
}
