#include <cmath>

#include "integrators/batch_cases.h"
#include "integrators/path.h"
#include "support/source_path.h"

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

double sum_of(const Image& image) {
  double sum = 0;
  for (const float v : image.data) sum += double(v);
  return sum;
}

/// `nested` below a normal map.
std::string mapped(const std::string& parameters, const std::string& nested) {
  return "<bsdf type='normalmap'>" + parameters +
         "<texture name='normalmap' type='checkerboard'><rgb name='color0' value='0.75,0.4,0.8'/>"
         "<rgb name='color1' value='0.3,0.65,0.85'/><transform name='to_uv'>"
         "<scale x='6' y='8'/></transform></texture>" +
         nested + "</bsdf>";
}
std::string on_both_sides(const std::string& bsdf) {
  return "<bsdf type='twosided'>" + bsdf + "</bsdf>";
}
/// `nested` below a bump map.
std::string bumped(const std::string& nested) {
  return "<bsdf type='bumpmap'><texture name='arbitrary' type='bitmap'><string name='filename' "
         "value='" +
         source_path("scenes/bsdf-wrappers/bumps.png") +
         "'/></texture><float name='scale' value='0.3'/>" + nested + "</bsdf>";
}

std::string masked(const std::string& opacity, const std::string& nested) {
  return "<bsdf type='mask'>" + opacity + nested + "</bsdf>";
}
/// An opacity, and one that differs from place to place.
std::string opacity(const char* value) {
  return std::string("<float name='opacity' value='") + value + "'/>";
}
std::string opacities(const char* first, const char* second) {
  const auto color = [](const char* name, const char* value) {
    return std::string("<rgb name='") + name + "' value='" + value + "'/>";
  };
  return "<texture name='opacity' type='checkerboard'>" + color("color0", first) +
         color("color1", second) +
         "<transform name='to_uv'><scale x='6' y='8'/></transform></texture>";
}

/// Masks over everything that has a loop, on meshes, balls and instances.
std::string masked_room() {
  return camera() + kLamp + kEnvironment +
         room_xml(masked(opacities("0.3", "1"), kVarnishedCheckers)) +
         lumpy_xml("-0.5,0.2,0.5", masked(opacity("0.7"), kAluminium)) +
         lumpy_xml("0.1,-0.5,1.4", masked(opacity("0.6"), kGlass)) +
         sphere_xml("0.5,-0.3,0.4", "0.3", masked(opacity("0.4"), smooth_plastic(""))) +
         sphere_xml("0.5,0.4,1.3", "0.3", masked(opacity("0.5"), rough_glass(""))) +
         "<shape type='cube'><transform name='to_world'><scale value='0.2'/>"
         "<translate x='-0.4' y='-0.4' z='1.1'/></transform>" +
         masked(opacities("0", "0.8"), grey("0.5")) +
         "</shape><shape type='shapegroup' id='g'><shape type='cube'>" +
         masked(opacities("0", "1"), kMirror) +
         "</shape></shape><shape type='instance'><ref id='g'/><transform name='to_world'>"
         "<scale value='0.2'/><rotate z='1' angle='30'/><translate y='-0.6' z='0.2'/></transform>"
         "</shape>";
}

/// A room below maps with such parameters, and balls.
std::string mapped_room(const std::string& parameters) {
  return camera() +
         room_xml(on_both_sides(mapped(parameters, ggx_plastic(kCheckerColours, false)))) +
         sphere_xml("-0.5,0.2,0.4", "0.35",
                    mapped(parameters, on_both_sides("<bsdf type='diffuse'/>"))) +
         hollow_xml("0.5,-0.3,0.5", "0.3",
                    on_both_sides(mapped(parameters, conductor("", false)))) +
         sphere_xml("0.5,0.4,1.3", "0.3", bumped(kPlastic)) +
         sphere_xml("0.1,-0.6,0.3", "0.2", masked(opacity("0.6"), bumped(grey("0.7")))) +
         sphere_xml("-0.4,-0.2,1.3", "0.25", on_both_sides(bumped(smooth_plastic("", false))));
}

constexpr const char* kMapParameters[] = {
    "",
    ("<boolean name='flip_invalid_normals' value='false'/>"
     "<boolean name='use_shadowing_function' value='false'/>"),
    "<boolean name='drops_leaks' value='false'/>",
};

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

TEST_CASE("at masks paths of a batch are those that are traced one by one") {
  const TransportScene scene(TemporaryDirectory(), masked_room());
  for (const int depth : {1, 2, 4, 30}) {
    CAPTURE(depth);
    PathLimits limits;
    limits.max_depth = depth;
    limits.rr_depth = 3;
    check_same(scene, batch_request(4, SampleSequence::sobol), limits);
  }
  PathLimits limits;
  limits.hide_emitters = limits.strict_normals = true;
  check_same(scene, batch_request(4, SampleSequence::independent), limits);
}

TEST_CASE("vertices below masks are not shared by groups of pixels") {
  const TransportScene scene(TemporaryDirectory(), masked_room());
  const RenderRequest r = batch_request(4, SampleSequence::sobol);
  PathIntegratorDescription grouped;
  grouped.pixel_group = 16;
  PathIntegrator path(grouped, {});
  const Image groups = render(*scene.scene, path, scene.layout, r).image;
  const Image alone = render_path(scene, PathBatches::where_possible, r).image;
  CHECK(differences(groups, alone) <= int(alone.data.size() / 200));
}

// There directions are chosen in another frame: what is the same are light samples.
TEST_CASE("below bump and normal maps batches have the same light samples") {
  PathLimits limits;
  limits.max_depth = 2;
  const std::string lamp =
      "<emitter type='point'><point name='position' x='0.3' y='-0.6' z='1.2'/>"
      "<rgb name='intensity' value='3,2,1'/></emitter>";
  for (const char* const parameters : kMapParameters) {
    CAPTURE(std::string(parameters));
    const TransportScene scene(TemporaryDirectory(), mapped_room(parameters) + lamp);
    const RenderRequest r = batch_request(4, SampleSequence::sobol);
    const Image batches = render_path(scene, PathBatches::where_possible, r, limits).image;
    const Image singly = render_path(scene, PathBatches::never, r, limits).image;
    CHECK(differences(batches, singly) <= int(singly.data.size() / 200));
  }
}

// It notices 0.15 % of the image.
TEST_CASE("below bump and normal maps batches have the same mean") {
  for (const char* const parameters : kMapParameters) {
    CAPTURE(std::string(parameters));
    const TransportScene scene(TemporaryDirectory(), mapped_room(parameters) + kLamp);
    constexpr int kSeeds = 10;
    double sum = 0, squares = 0, light = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
      RenderRequest r = batch_request(64, SampleSequence::sobol);
      r.seed = uint64_t(seed);
      const double a = sum_of(render_path(scene, PathBatches::where_possible, r).image),
                   b = sum_of(render_path(scene, PathBatches::never, r).image);
      sum += a - b, squares += (a - b) * (a - b), light += b;
    }
    const double error = std::sqrt((squares - sum * sum / kSeeds) * kSeeds / (kSeeds - 1)) / light;
    CAPTURE(sum / light);
    CHECK(error < 0.0004);
    CHECK(std::abs(sum / light) < 4 * error);
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
