#include "integrators/wide_light_walk.h"

#include "integrators/batch_cases.h"
#include "integrators/bidirectional.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr BidirectionalMethod kMethods[] = {BidirectionalMethod::ptracer, BidirectionalMethod::ppm,
                                            BidirectionalMethod::bpm};

RenderResult render_light(const TransportScene& s, PathBatches batches, const RenderRequest& r,
                          BidirectionalMethod method, const CameraOutput& output = {}) {
  BidirectionalIntegratorDescription options;
  options.method = method;
  options.max_depth = 6;
  options.rr_depth = 3;
  options.radius = 0.05;
  BidirectionalIntegrator integrator(options, output, batches);
  return render(*s.scene, integrator, s.layout, r);
}

/// The vertices of a pass by a tracer, or without one.
struct Traced {
  LightPass pass;
  RenderCounters counters;
  std::vector<LightSplat> splats;

  Traced(const Scene& scene, LightPassPlan plan, LightTracer* tracer) {
    plan.tracer = tracer;
    const auto take = [&](std::span<const LightSplat> s, RenderCounters&) {
      splats.insert(splats.end(), s.begin(), s.end());
    };
    pass.run(scene, plan, take, counters);
  }
  std::span<const LightVertex> subpath(size_t i) const { return pass.vertices().subpath(i); }
  std::span<const ConnectionVertex> connection_vertices(size_t i) const {
    return pass.vertices().part_of(pass.connection_vertices(), i);
  }
};

bool close(float a, float b) {
  return std::abs(a - b) <= 1e-4f * (1 + std::abs(b));
}
bool close(const Spectrum& a, const Spectrum& b) {
  return close(a.r, b.r) && close(a.g, b.g) && close(a.b, b.b);
}
bool close(const LightVertex& a, const LightVertex& b) {
  return a.shape == b.shape && a.primitive == b.primitive && a.instance == b.instance &&
         a.depth == b.depth && a.merges == b.merges && length(a.position - b.position) < 1e-4f &&
         close(a.arriving, b.arriving) && close(a.partials.vcm, b.partials.vcm) &&
         close(a.partials.vc, b.partials.vc) && close(a.partials.vm, b.partials.vm) &&
         std::abs(a.barycentric[0] - b.barycentric[0]) < 8 &&
         std::abs(a.barycentric[1] - b.barycentric[1]) < 8 &&
         length(a.direction_to_previous() - b.direction_to_previous()) < 1e-4f;
}
bool close(const ConnectionVertex& a, const ConnectionVertex& b) {
  // Only batches tell glossy materials from others.
  const bool diffuse = a.material == ConnectionVertex::kDiffuse;
  if (diffuse != (b.material == ConnectionVertex::kDiffuse)) return false;
  if (a.depth != b.depth || a.faces != b.faces) return false;
  const bool placed =
      length(a.position - b.position) < 1e-4f && length(Vector3f(a.lit) - Vector3f(b.lit)) < 1e-4f;
  if (a.faces && !placed) return false;
  return !diffuse ||
         (close(a.flux, b.flux) && close(a.reverse, b.reverse) && close(a.adjoint, b.adjoint) &&
          close(a.offset, b.offset) && close(a.vcm, b.vcm) && close(a.vc, b.vc) &&
          close(a.vm, b.vm) && length(Vector3f(a.ng) - Vector3f(b.ng)) < 1e-4f);
}
template <class T>
bool close(std::span<const T> a, std::span<const T> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return close(x, y); });
}

LightPassPlan plan_of(uint32_t subpaths, SampleSequence sequence) {
  LightPassPlan plan;
  plan.set.light_samples = plan.set.hits = plan.set.camera_connections = plan.set.connections =
      true;
  plan.set.merges = true;
  plan.set.merge_area = 0.01f;
  plan.set.light_paths = float(subpaths);
  plan.subpath.rr_depth = 3;
  plan.max_depth = 7;
  plan.subpaths = subpaths;
  plan.keep_vertices = plan.keep_connection_vertices = true;
  plan.sequence = sequence;
  plan.seed = 5;
  plan.iteration = 2;
  return plan;
}

}  // namespace

TEST_CASE("light sub-paths of a batch have the vertices of those that are traced one by one") {
  for (const BatchCase& c : kBatchCases)
    for (const auto sequence : {SampleSequence::sobol, SampleSequence::independent}) {
      CAPTURE(std::string(c.name));
      const TransportScene scene = c.scene();
      const WideScene wide(*scene.scene, WideUse::merging);
      WideLightTracer tracer(wide);
      const LightPassPlan plan = plan_of(3000, sequence);
      const Traced batches(*scene.scene, plan, &tracer), singly(*scene.scene, plan, nullptr);
      REQUIRE(batches.pass.vertices().ends.size() == plan.subpaths);
      REQUIRE(batches.pass.connection_vertices().size() == batches.pass.vertices().vertices.size());
      int different = 0;
      for (uint32_t i = 0; i < plan.subpaths; ++i)
        different += batches.pass.vertices().lengths[i] != singly.pass.vertices().lengths[i] ||
                     !close(batches.subpath(i), singly.subpath(i)) ||
                     !close(batches.connection_vertices(i), singly.connection_vertices(i));
      // But for rays that meet an edge, and what rounding decides otherwise.
      CHECK(different <= int(plan.subpaths / 200));
      CHECK(singly.pass.vertices().vertices.size() > plan.subpaths / 2);
      CHECK(double(batches.splats.size()) ==
            doctest::Approx(double(singly.splats.size())).epsilon(2e-3));
      CHECK(batches.counters.light_paths == singly.counters.light_paths);
    }
}

TEST_CASE("methods that trace light sub-paths make the same image of batches and one by one") {
  for (const BatchCase& c : kBatchCases)
    for (const BidirectionalMethod method : kMethods) {
      CAPTURE(std::string(c.name));
      CAPTURE(int(method));
      const TransportScene scene = c.scene();
      const RenderRequest r = batch_request(4, SampleSequence::sobol);
      const RenderResult batches = render_light(scene, PathBatches::where_possible, r, method),
                         singly = render_light(scene, PathBatches::never, r, method);
      CHECK(differences(batches.image, singly.image) <= int(singly.image.data.size() / 200));
      for (const auto counter :
           {&RenderCounters::closest_rays, &RenderCounters::shadow_rays, &RenderCounters::merges})
        CHECK(double(batches.counters.*counter) ==
              doctest::Approx(double(singly.counters.*counter)).epsilon(2e-3));
      CHECK(batches.counters.light_paths == singly.counters.light_paths);
    }
}

TEST_CASE("images of each technique come of batches of light sub-paths, too") {
  const TransportScene scene(kBatchCases[3].content);
  CameraOutput output;
  output.techniques = TechniqueOutput::raw;
  const RenderRequest r = batch_request(4, SampleSequence::sobol);
  const auto method = BidirectionalMethod::bdpt;
  const RenderResult batches = render_light(scene, PathBatches::where_possible, r, method, output),
                     singly = render_light(scene, PathBatches::never, r, method, output);
  CHECK(differences(batches.image, singly.image) <= int(singly.image.data.size() / 200));
}

TEST_CASE("batches of light sub-paths make the same image on any number of threads") {
  const TransportScene scene(coplanar());
  RenderRequest r = batch_request(6, SampleSequence::sobol, 1);
  const auto method = BidirectionalMethod::ptracer;
  const Image one = render_light(scene, PathBatches::where_possible, r, method).image;
  for (const int threads : {2, 7}) {
    r.threads = threads;
    CHECK(render_light(scene, PathBatches::where_possible, r, method).image.data == one.data);
  }
}
