// How much of the speed of bare ray queries is left while rendering.
//
//   rays SCENE.xml [WIDTHxHEIGHT] [SPP] [ROUNDS] [NAME=VALUE...]
//
// Renders on one thread and records every ray on its way to Embree, alone or in a packet, by
// standing between the program and the library; then asks Embree for the same rays, in the same
// packets, in a bare loop. Both are timed in turn, round by round, and the median of the ratios is
// printed.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

namespace {

bool recording = false;
RTCScene recorded_scene = nullptr;

/// A query as it was asked: which of the rays are valid, and the rays.
template <class Rays, size_t kWidth>
struct Query {
  alignas(64) int valid[kWidth];
  Rays rays;
  size_t count() const { return size_t(std::count(valid, valid + kWidth, -1)); }
};
std::vector<Query<RTCRayHit, 1>> closest_1;
std::vector<Query<RTCRayHit8, 8>> closest_8;
std::vector<Query<RTCRayHit16, 16>> closest_16;
std::vector<Query<RTCRay, 1>> shadow_1;
std::vector<Query<RTCRay8, 8>> shadow_8;
std::vector<Query<RTCRay16, 16>> shadow_16;

template <class Rays, size_t kWidth>
void record(std::vector<Query<Rays, kWidth>>& queries, RTCScene scene, const int* valid,
            const Rays& rays) {
  if (!recording) return;
  recorded_scene = scene;
  queries.push_back({{}, rays});
  std::copy_n(valid, kWidth, queries.back().valid);
}

constexpr int kOne = -1;

template <class F>
F* next(const char* name) {
  return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// What a query takes between the scene and the rays, and after them.
#if RTC_VERSION_MAJOR >= 4
#define DUET_BEFORE
#define DUET_BEFORE_VALUE
#define DUET_AFTER(arguments) , arguments* after
#define DUET_AFTER_VALUE , after
#else
#define DUET_BEFORE RTCIntersectContext *before,
#define DUET_BEFORE_VALUE before,
#define DUET_AFTER(arguments)
#define DUET_AFTER_VALUE
#endif

// Each stands between the program and Embree.
#define DUET_RECORD_ONE(function, Rays, arguments, queries)                             \
  RTC_API void function(RTCScene scene, DUET_BEFORE Rays* rays DUET_AFTER(arguments)) { \
    static auto* const real = next<decltype(function)>(#function);                      \
    record(queries, scene, &kOne, *rays);                                               \
    real(scene, DUET_BEFORE_VALUE rays DUET_AFTER_VALUE);                               \
  }
#define DUET_RECORD_PACKET(function, Rays, arguments, queries)          \
  RTC_API void function(const int* valid, RTCScene scene,               \
                        DUET_BEFORE Rays* rays DUET_AFTER(arguments)) { \
    static auto* const real = next<decltype(function)>(#function);      \
    record(queries, scene, valid, *rays);                               \
    real(valid, scene, DUET_BEFORE_VALUE rays DUET_AFTER_VALUE);        \
  }
DUET_RECORD_ONE(rtcIntersect1, RTCRayHit, RTCIntersectArguments, closest_1)
DUET_RECORD_ONE(rtcOccluded1, RTCRay, RTCOccludedArguments, shadow_1)
DUET_RECORD_PACKET(rtcIntersect8, RTCRayHit8, RTCIntersectArguments, closest_8)
DUET_RECORD_PACKET(rtcOccluded8, RTCRay8, RTCOccludedArguments, shadow_8)
DUET_RECORD_PACKET(rtcIntersect16, RTCRayHit16, RTCIntersectArguments, closest_16)
DUET_RECORD_PACKET(rtcOccluded16, RTCRay16, RTCOccludedArguments, shadow_16)

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

#if RTC_VERSION_MAJOR >= 4
#define DUET_CONTEXT(rays) rays, nullptr
#else
#define DUET_CONTEXT(rays) &context, rays
#endif

/// The recorded rays once more, with nothing around them.
double bare_loop() {
  const auto start = Clock::now();
#if RTC_VERSION_MAJOR < 4
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
#endif
  RTCScene scene = recorded_scene;
  for (auto q : closest_1) rtcIntersect1(scene, DUET_CONTEXT(&q.rays));
  for (auto q : shadow_1) rtcOccluded1(scene, DUET_CONTEXT(&q.rays));
  for (auto q : closest_8) rtcIntersect8(q.valid, scene, DUET_CONTEXT(&q.rays));
  for (auto q : shadow_8) rtcOccluded8(q.valid, scene, DUET_CONTEXT(&q.rays));
  for (auto q : closest_16) rtcIntersect16(q.valid, scene, DUET_CONTEXT(&q.rays));
  for (auto q : shadow_16) rtcOccluded16(q.valid, scene, DUET_CONTEXT(&q.rays));
  return seconds_since(start);
}

template <class... Queries>
double count_rays(const Queries&... of_width) {
  size_t count = 0;
  const auto add = [&](const auto& queries) {
    for (const auto& q : queries) count += q.count();
  };
  (add(of_width), ...);
  return double(count);
}

int run(int argc, char** argv) {
  using namespace duet;
  if (argc < 2) {
    fmt::print(stderr, "usage: rays SCENE.xml [WIDTHxHEIGHT] [SPP] [ROUNDS] [NAME=VALUE...]\n");
    return 2;
  }
  int width = 256, height = 256;
  if (argc > 2 && std::sscanf(argv[2], "%dx%d", &width, &height) != 2) return 2;
  const int spp = argc > 3 ? std::atoi(argv[3]) : 4;
  const int rounds = argc > 4 ? std::atoi(argv[4]) : 7;
  MitsubaOptions options;
  for (int i = 5; i < argc; ++i) {
    const std::string define = argv[i];
    const size_t equals = define.find('=');
    if (equals == std::string::npos) return 2;
    options.defines.emplace_back(define.substr(0, equals), define.substr(equals + 1));
  }
  Diagnostics diagnostics;
  auto file = read_mitsuba(argv[1], options, diagnostics);
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Integrator> integrator;
  FilmLayout layout;
  if (file) {
    FilmDescription& film = file->description.sensors.at(0).film;
    film.width = width, film.height = height;
    layout = {{width, height}, {0, 0, width, height}, film.filter};
    integrator = make_integrator(file->description.integrator);
    scene = build_scene(std::move(file->description), {}, diagnostics);
  }
  for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", d.to_string());
  if (!scene) return 1;

  RenderRequest request;
  request.budget.spp = spp;
  recording = true;
  RenderResult result = render(*scene, *integrator, layout, request);
  recording = false;
  const double shadow = count_rays(shadow_1, shadow_8, shadow_16);
  const double rays = shadow + count_rays(closest_1, closest_8, closest_16);
  std::vector<double> shares, bare_rates, rates;
  for (int i = 0; i < rounds; ++i) {
    result = render(*scene, *integrator, layout, request);
    const double bare = bare_loop();
    shares.push_back(bare / result.seconds);
    bare_rates.push_back(rays / bare * 1e-6);
    rates.push_back(rays / result.seconds * 1e-6);
  }
  const auto median = [](std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  };
  fmt::print("{} rays ({:.0f} % shadow rays), {:.2f} per path\n", rays, 100 * shadow / rays,
             rays / double(result.counters.camera_paths));
  fmt::print("bare {:.2f} Mrays/s, rendering {:.2f} Mrays/s, share {:.3f} (median of {} rounds)\n",
             median(bare_rates), median(rates), median(shares), rounds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv);
}
