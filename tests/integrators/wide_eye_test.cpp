#include "integrators/wide_eye.h"

#include <array>

#include "integrators/batch_cases.h"
#include "integrators/bidirectional.h"

using namespace duet;
using namespace duet::test;

namespace {

RenderResult render_bdpt(const TransportScene& s, PathBatches batches, const RenderRequest& r,
                         const BidirectionalIntegratorDescription& options = {}) {
  BidirectionalIntegrator bdpt(options, {}, batches);
  return render(*s.scene, bdpt, s.layout, r);
}

void check_close(uint64_t a, uint64_t b, double tolerance = 2e-3) {
  CHECK(double(a) == doctest::Approx(double(b)).epsilon(tolerance));
}

void check_same_work(const RenderCounters& a, const RenderCounters& b, bool hide_emitters) {
  // One by one all rays of the camera are traced once more where emitters are hidden.
  check_close(a.closest_rays, b.closest_rays - (hide_emitters ? b.camera_paths : 0));
  check_close(a.shadow_rays, b.shadow_rays);
  check_close(a.path_vertices, b.path_vertices);
  check_close(a.connections.contributed, b.connections.contributed);
  check_close(a.connections.failed_occluded, b.connections.failed_occluded);
  check_close(a.connections.failed_specular, b.connections.failed_specular);
  // What is next to nothing, as facets far from where they mostly face, is nothing in another
  // order.
  const ConnectionCounters &c = a.connections, &d = b.connections;
  check_close(c.failed_zero + c.skipped, d.failed_zero + d.skipped);
  check_close(c.failed_zero, d.failed_zero, 5e-3);
  check_close(c.skipped, d.skipped, 5e-3);
  CHECK(a.camera_paths == b.camera_paths);
}

/// Whether batches make the image that is made one by one, with the same work; returns the counters
/// of both, of the batches first.
std::array<RenderCounters, 2> check_same(const TransportScene& scene, const RenderRequest& r,
                                         const BidirectionalIntegratorDescription& options) {
  const RenderResult batches = render_bdpt(scene, PathBatches::where_possible, r, options),
                     singly = render_bdpt(scene, PathBatches::never, r, options);
  // But for rays that meet an edge, and what rounding decides otherwise.
  CHECK(differences(batches.image, singly.image) <= int(singly.image.data.size() / 200));
  check_same_work(batches.counters, singly.counters, options.hide_emitters);
  return {batches.counters, singly.counters};
}

}  // namespace

TEST_CASE("eye sub-paths of a batch are those that are traced one by one") {
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    for (const int depth : {1, 3, 20})
      for (const double light_paths : {0.25, 1.0}) {
        CAPTURE(depth);
        CAPTURE(light_paths);
        BidirectionalIntegratorDescription options;
        options.max_depth = depth;
        options.rr_depth = 3;
        options.light_paths = light_paths;
        const RenderRequest r =
            batch_request(4, light_paths < 1 ? SampleSequence::sobol : SampleSequence::independent);
        check_same(scene, r, options);
      }
  }
}

TEST_CASE("batches of eye sub-paths hide emitters and drop what two normals see differently") {
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    for (const int connections : {-1, 19}) {
      CAPTURE(connections);
      BidirectionalIntegratorDescription options;
      options.method = BidirectionalMethod::vcm;
      options.max_depth = 6;
      options.radius = 0.05;
      options.connections = connections;
      options.hide_emitters = options.strict_normals = true;
      const auto [batches, singly] =
          check_same(scene, batch_request(2, SampleSequence::sobol), options);
      check_close(batches.merges, singly.merges);
    }
  }
}

TEST_CASE("batches of eye sub-paths connect no light that two normals see differently") {
  // Eight triangles with the normals of a ball: many directions are above one of the two horizons
  // alone.
  const TemporaryDirectory folder;
  folder.write("octahedron.obj",
               "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
               "vn 1 0 0\nvn -1 0 0\nvn 0 1 0\nvn 0 -1 0\nvn 0 0 1\nvn 0 0 -1\n"
               "f 1//1 3//3 5//5\nf 3//3 2//2 5//5\nf 2//2 4//4 5//5\nf 4//4 1//1 5//5\n"
               "f 3//3 1//1 6//6\nf 2//2 3//3 6//6\nf 4//4 2//2 6//6\nf 1//1 4//4 6//6\n");
  const TransportScene scene(
      folder,
      camera_xml("0,-3.2,1", "0,0,1", 24) + room_xml(grey("0.6")) + kLamp +
          "<shape type='obj'><string name='filename' value='octahedron.obj'/>"
          "<transform name='to_world'><scale value='0.7'/><translate z='0.9'/></transform>" +
          grey("0.8") + "</shape>");
  for (const int connections : {-1, 19}) {
    CAPTURE(connections);
    BidirectionalIntegratorDescription options;
    options.max_depth = 4;
    options.connections = connections;
    const RenderRequest r = batch_request(4, SampleSequence::sobol);
    const RenderResult both = render_bdpt(scene, PathBatches::where_possible, r, options);
    options.strict_normals = true;
    const auto [strict, singly] = check_same(scene, r, options);
    CHECK(strict.connections.contributed < 0.995 * double(both.counters.connections.contributed));
  }
}

TEST_CASE("batches of eye sub-paths need no connections") {
  const TransportScene scene(kBatchCases[0].content);
  BidirectionalIntegratorDescription options;
  options.connections = 0;
  check_same(scene, batch_request(4, SampleSequence::sobol), options);
}

TEST_CASE("batches of eye sub-paths draw the light vertices that one draws") {
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    for (const auto method : {BidirectionalMethod::bdpt, BidirectionalMethod::vcm}) {
      BidirectionalIntegratorDescription options;
      options.method = method;
      options.max_depth = 6;
      options.radius = 0.05;
      // More than are looked up ahead.
      options.connections = 19;
      const auto [batches, singly] =
          check_same(scene, batch_request(2, SampleSequence::sobol), options);
      CHECK(singly.connections.contributed > 0);
    }
  }
}

TEST_CASE("batches merge photons as one eye sub-path does, everywhere or in parts of the image") {
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    for (const bool in_parts : {false, true}) {
      CAPTURE(in_parts);
      BidirectionalIntegratorDescription options;
      options.method = BidirectionalMethod::vcm;
      options.rr_depth = 3;
      options.radius = 0.05;
      if (in_parts) {
        options.merge_parts.assign(MergeMask::kSide * MergeMask::kSide, 0);
        for (size_t i = 0; i < options.merge_parts.size(); i += 3) options.merge_parts[i] = 1;
      }
      const auto [batches, singly] =
          check_same(scene, batch_request(3, SampleSequence::sobol), options);
      check_close(batches.merges, singly.merges);
      check_close(batches.merge_queries, singly.merge_queries);
      CHECK(singly.merges > 0);
    }
  }
}

TEST_CASE("batches of eye sub-paths make the same image on any number of threads") {
  const TransportScene scene(coplanar());
  RenderRequest r = batch_request(6, SampleSequence::sobol, 1);
  const Image one = render_bdpt(scene, PathBatches::where_possible, r).image;
  for (const int threads : {2, 7}) {
    r.threads = threads;
    CHECK(render_bdpt(scene, PathBatches::where_possible, r).image.data == one.data);
  }
  r.pass_seconds = 0;
  CHECK(render_bdpt(scene, PathBatches::where_possible, r).image.data == one.data);
}

TEST_CASE("what is not finite is counted and left out of batches of eye sub-paths, too") {
  const TransportScene scene(camera() + room_xml(grey("0.5")) + lamp_xml("0.4", "1e38,1e38,1e38"));
  const RenderRequest r = batch_request(2, SampleSequence::sobol);
  const RenderResult batches = render_bdpt(scene, PathBatches::where_possible, r);
  CHECK(batches.counters.nonfinite_samples > 0);
  for (const float v : batches.image.data) REQUIRE(std::isfinite(v));
}
