// How much of the speed of bare ray queries is left while rendering.
//
//   rays SCENE.xml [WIDTHxHEIGHT] [SPP] [ROUNDS] [NAME=VALUE...]
//
// Renders on one thread and records every ray on its way to Embree, by standing between the program
// and the library; then asks Embree for the same rays in a bare loop. Both are timed in turn, round
// by round, and the median of the ratios is printed.
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
std::vector<RTCRay> closest_rays, shadow_rays;

template <class F>
F* next(const char* name) {
  return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#if RTC_VERSION_MAJOR >= 4
RTC_API void rtcIntersect1(RTCScene scene, RTCRayHit* rh, RTCIntersectArguments* args) {
  static auto* const real = next<decltype(rtcIntersect1)>("rtcIntersect1");
  if (recording) recorded_scene = scene, closest_rays.push_back(rh->ray);
  real(scene, rh, args);
}
RTC_API void rtcOccluded1(RTCScene scene, RTCRay* ray, RTCOccludedArguments* args) {
  static auto* const real = next<decltype(rtcOccluded1)>("rtcOccluded1");
  if (recording) shadow_rays.push_back(*ray);
  real(scene, ray, args);
}
#else
RTC_API void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* rh) {
  static auto* const real = next<decltype(rtcIntersect1)>("rtcIntersect1");
  if (recording) recorded_scene = scene, closest_rays.push_back(rh->ray);
  real(scene, context, rh);
}
RTC_API void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  static auto* const real = next<decltype(rtcOccluded1)>("rtcOccluded1");
  if (recording) shadow_rays.push_back(*ray);
  real(scene, context, ray);
}
#endif

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The recorded rays once more, with nothing around them.
double bare_loop() {
  const auto start = Clock::now();
#if RTC_VERSION_MAJOR < 4
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
#endif
  for (const RTCRay& ray : closest_rays) {
    RTCRayHit rh;
    rh.ray = ray;
    rh.hit.geomID = rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(recorded_scene, &rh, nullptr);
#else
    rtcIntersect1(recorded_scene, &context, &rh);
#endif
  }
  for (const RTCRay& ray : shadow_rays) {
    RTCRay r = ray;
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(recorded_scene, &r, nullptr);
#else
    rtcOccluded1(recorded_scene, &context, &r);
#endif
  }
  return seconds_since(start);
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
  const double rays = double(closest_rays.size() + shadow_rays.size());
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
  fmt::print("{} rays ({:.0f} % shadow rays), {:.2f} per path\n", rays,
             100 * double(shadow_rays.size()) / rays, rays / double(result.counters.camera_paths));
  fmt::print("bare {:.2f} Mrays/s, rendering {:.2f} Mrays/s, share {:.3f} (median of {} rounds)\n",
             median(bare_rates), median(rates), median(shares), rounds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv);
}
