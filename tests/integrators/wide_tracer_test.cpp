#include "integrators/path.h"

#include "integrators/batch_cases.h"

using namespace duet;
using namespace duet::test;

namespace {

RenderResult render_path(const TransportScene& s, PathBatches batches, const RenderRequest& r,
                         PathLimits limits = {}) {
  PathIntegrator path({limits}, {}, batches);
  return render(*s.scene, path, s.layout, r);
}

}  // namespace

TEST_CASE("paths of a batch are those that are traced one by one") {
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    for (const SampleSequence sequence : {SampleSequence::sobol, SampleSequence::independent})
      for (const int depth : {1, 3, 20}) {
        CAPTURE(depth);
        PathLimits limits;
        limits.max_depth = depth;
        limits.rr_depth = 3;
        const RenderRequest r = batch_request(4, sequence);
        const RenderResult batches = render_path(scene, PathBatches::where_possible, r, limits),
                           singly = render_path(scene, PathBatches::never, r, limits);
        // But for paths that meet an edge, or that rounding has led elsewhere.
        CHECK(differences(batches.image, singly.image) <= int(singly.image.data.size() / 200));
        CHECK(double(batches.counters.closest_rays) ==
              doctest::Approx(double(singly.counters.closest_rays)).epsilon(1e-3));
        CHECK(double(batches.counters.shadow_rays) ==
              doctest::Approx(double(singly.counters.shadow_rays)).epsilon(1e-3));
        CHECK(double(batches.counters.path_vertices) ==
              doctest::Approx(double(singly.counters.path_vertices)).epsilon(1e-3));
        CHECK(batches.counters.camera_paths == singly.counters.camera_paths);
      }
  }
}

TEST_CASE("batches make the same image on any number of threads and in any passes") {
  const TransportScene scene(coplanar());
  RenderRequest r = batch_request(6, SampleSequence::sobol, 1);
  const Image one = render_path(scene, PathBatches::where_possible, r).image;
  for (const int threads : {2, 7}) {
    r.threads = threads;
    CHECK(render_path(scene, PathBatches::where_possible, r).image.data == one.data);
  }
  r.pass_seconds = 0;
  CHECK(render_path(scene, PathBatches::where_possible, r).image.data == one.data);
}

TEST_CASE("a window of an image made in batches is cut out of it") {
  TransportScene scene(coplanar());
  const RenderRequest r = batch_request(3, SampleSequence::sobol);
  const Image whole = render_path(scene, PathBatches::where_possible, r).image;
  scene.layout.crop = {5, 11, 23, 37};
  const Image window = render_path(scene, PathBatches::where_possible, r).image;
  int same = 0;
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      for (int c = 0; c < 4; ++c)
        same += window.data[size_t((y * window.width + x) * 4 + c)] ==
                whole.data[size_t(((y + 11) * whole.width + x + 5) * 4 + c)];
  CHECK(same == window.width * window.height * 4);
}

TEST_CASE("samples that are not finite are counted and left out in batches, too") {
  const TransportScene scene(camera() + room_xml(grey("0.5")) + lamp_xml("0.4", "1e38,1e38,1e38"));
  const RenderRequest r = batch_request(2, SampleSequence::sobol);
  const RenderResult batches = render_path(scene, PathBatches::where_possible, r),
                     singly = render_path(scene, PathBatches::never, r);
  CHECK(singly.counters.nonfinite_samples > 0);
  CHECK(batches.counters.nonfinite_samples == singly.counters.nonfinite_samples);
}
