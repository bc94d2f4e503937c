#include "integrators/path.h"

#include "integrators/batch_cases.h"

using namespace duet;
using namespace duet::test;

namespace {

RenderResult render_path(const TransportScene& s, PathBatches batches, const RenderRequest& r,
                         PathLimits limits = {}, const CameraOutput& output = {}) {
  PathIntegrator path({limits}, output, batches);
  return render(*s.scene, path, s.layout, r);
}

void check_same(const TransportScene& scene, const RenderRequest& r, const PathLimits& limits,
                const CameraOutput& output = {}) {
  const RenderResult batches = render_path(scene, PathBatches::where_possible, r, limits, output),
                     singly = render_path(scene, PathBatches::never, r, limits, output);
  // But for paths that meet an edge, or that rounding has led elsewhere.
  CHECK(differences(batches.image, singly.image) <= int(singly.image.data.size() / 200));
  // One by one all rays of the camera are traced once more where emitters are hidden.
  const uint64_t again = limits.hide_emitters ? singly.counters.camera_paths : 0;
  CHECK(double(batches.counters.closest_rays) ==
        doctest::Approx(double(singly.counters.closest_rays - again)).epsilon(1e-3));
  for (const auto counter : {&RenderCounters::shadow_rays, &RenderCounters::path_vertices})
    CHECK(double(batches.counters.*counter) ==
          doctest::Approx(double(singly.counters.*counter)).epsilon(1e-3));
  CHECK(batches.counters.camera_paths == singly.counters.camera_paths);
  CHECK(batches.counters.nonfinite_samples == singly.counters.nonfinite_samples);
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
        check_same(scene, batch_request(4, sequence), limits);
      }
  }
}

TEST_CASE("batches hide emitters and drop directions that two normals see differently") {
  PathLimits limits;
  limits.hide_emitters = limits.strict_normals = true;
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    check_same(c.scene(), batch_request(4, SampleSequence::sobol), limits);
  }
}

TEST_CASE("layers beside colours that were made in batches are those of paths one by one") {
  CameraOutput output;
  for (const char* const name :
       {"albedo", "normal", "depth", "dz_dx", "denoise_albedo", "denoise_split", "variance"})
    output.layers.push_back({*find_layer(name), name});
  for (const size_t number : {1, 2, 3}) {
    const BatchCase& c = kBatchCases[number];
    CAPTURE(std::string(c.name));
    check_same(c.scene(), batch_request(4, SampleSequence::sobol), {}, output);
  }
}

TEST_CASE("layers without colours are not traced in batches") {
  CameraOutput output;
  output.image = false;
  for (const char* const name : {"normal", "depth"})
    output.layers.push_back({*find_layer(name), name});
  check_same(kBatchCases[0].scene(), batch_request(2, SampleSequence::sobol), {}, output);
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
