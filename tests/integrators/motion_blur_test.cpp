// Scenes that move are the mean of scenes that stand still.
#include "integrators/motion_blur.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "image/image_io.h"
#include "image/tile_test.h"
#include "scene/scene_motion.h"
#include "support/statistics.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kMovingSize = 16;

std::string animation(const std::string& first, const std::string& last) {
  return "<animation name='toWorld'><transform time='1'>" + first +
         "</transform><transform time='3'>" + last + "</transform></animation>";
}

/// A camera whose shutter is open from 1.5 to 3, either moving or not.
std::string camera(const std::string& place, const std::string& type = "perspective") {
  const std::string size = std::to_string(kMovingSize);
  return "<sensor type='" + type + "'><float name='shutterOpen' value='1.5'/>" +
         "<float name='shutterClose' value='3'/><float name='fov' value='50'/>" + place +
         "<film type='hdrfilm'><integer name='width' value='" + size +
         "'/><integer name='height' value='" + size +
         "'/><rfilter type='box'/></film></sensor><integrator type='path'>" +
         "<integer name='maxDepth' value='4'/></integrator>";
}
const std::string kView = "<lookat origin='0,-3.5,1' target='0,0,1' up='0,0,1'/>";
const std::string kStillCamera = camera("<transform name='toWorld'>" + kView + "</transform>");
const std::string kLamp =
    "<shape type='rectangle'><transform name='toWorld'><scale value='0.3'/><rotate x='1' "
    "angle='180'/><translate z='1.9'/></transform><emitter type='area'><rgb name='radiance' "
    "value='9'/></emitter></shape>";
const std::string kRoom = room_xml(grey("0.6"));
const std::string kGlow = "<emitter type='area'><rgb name='radiance' value='5 7 9'/></emitter>";

/// Across the room, turning and growing.
const std::string kWay = animation("<scale value='0.2'/><translate x='-0.8' y='-0.3' z='0.4'/>",
                                   "<scale x='0.4' y='0.3' z='0.3'/><rotate x='1' y='1' "
                                   "angle='100'/><translate x='0.6' y='0.2' z='1.3'/>");

std::string moving_shape(const std::string& type, const std::string& content = "") {
  return "<shape type='" + type + "'>" + content + kWay + "</shape>";
}

const std::string kMovingInstance =
    "<shape type='shapegroup' id='g'><shape type='cube'>" + grey("0.3") +
    "</shape><shape type='sphere'><point name='center' x='1' y='0' z='0.5'/></shape></shape>"
    "<shape type='instance'><ref id='g'/>" +
    kWay + "</shape>";

const std::string kMovingCamera =
    camera(animation(kView, "<lookat origin='1,-3,1.5' target='0.2,0,1' up='0.1,0,1'/>"));

/// What is described before it is built, with the size of its image.
struct Described {
  SceneDescription description;
  FilmLayout layout;
  explicit Described(const std::string& content) {
    ReadResult read = read_text("<scene version='0.6.0'>" + content + "</scene>");
    REQUIRE_MESSAGE(read.scene, read.messages());
    description = read.scene->description;
    const FilmDescription& f = description.sensors.at(0).film;
    layout = {{f.width, f.height}, {0, 0, f.width, f.height}, f.filter};
  }
  std::unique_ptr<Scene> build(const SceneDescription& what) const {
    Diagnostics diagnostics;
    BuildOptions options;
    options.threads = 2;
    auto scene = build_scene(what, options, diagnostics);
    REQUIRE(scene);
    return scene;
  }
  std::unique_ptr<Scene> at_share(double share) const {
    const auto [open, close] = description.sensors[0].shutter;
    auto scene = build(scene_at(description, (1 - share) * open + share * close));
    REQUIRE(!scene->motion);
    return scene;
  }
  std::unique_ptr<Integrator> method(const std::string& name) const {
    IntegratorDescription d = description.integrator;
    apply_override(d, {name, {}, {}});
    return make_integrator(d);
  }
};

/// The image of a method that begins with `first`; `passes` adds the range's samples to the film.
template <class Passes>
Image image_of(const Described& d, const std::string& method, const Scene& first,
               const SampleRange& range, Passes passes) {
  const auto integrator = d.method(method);
  integrator->begin(first, {d.layout.full, int(range.count), 2});
  Film film(d.layout, integrator->channels());
  integrator->prepare(film);
  RenderCounters counters;
  PassControl control;
  control.threads = 2;
  passes([&](const Scene& scene, const SampleRange& samples) {
    integrator->render_pass(scene, film, samples, control, counters);
  });
  return film.develop();
}

/// The moving scene, as one pass.
Image moving_image(const Described& d, const std::string& method, const SampleRange& range) {
  const auto scene = d.build(d.description);
  REQUIRE(scene->motion);
  return image_of(d, method, *scene, range, [&](const auto& pass) { pass(*scene, range); });
}

/// How the moving scene's samples are divided.
MotionPhases phases_of(const Described& d, const std::string& method, const SampleRange& range) {
  MotionPhases phases;
  phases.start(*d.build(d.description), d.layout.full, d.method(method)->most_phases(d.layout.full),
               range);
  return phases;
}

/// The same samples with a scene built anew for each phase of them, for the share of the open time
/// that `share` gives.
template <class Share>
Image still_image(const Described& d, const std::string& method, const SampleRange& range,
                  const MotionPhases& phases, Share share) {
  // Where methods begin.
  const auto first = d.at_share(0.5);
  return image_of(d, method, *first, range, [&](const auto& pass) {
    SampleRange one = range;
    one.count = 1;
    for (uint32_t i = range.first; i < range.first + range.count; ++i)
      for (uint32_t k = 0; k < phases.count(i); ++k) {
        const PixelPhase phase = phases.phase(i, k);
        one.first = i;
        one.phase = phase.count > 1 ? &phase : nullptr;
        pass(*d.at_share(share(i, k)), one);
      }
  });
}

/// With the times at which the renderer sees them.
Image still_image(const Described& d, const std::string& method, const SampleRange& range) {
  const auto time = [&](uint32_t sample, uint32_t phase) {
    return time_of_sample(range, sample, phase);
  };
  return still_image(d, method, range, phases_of(d, method, range), time);
}

/// Sum of all differences, relative to that of all values.
double difference(const Image& a, const Image& b) {
  REQUIRE(a.data.size() == b.data.size());
  double differences = 0, values = 0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    differences += std::abs(double(a.data[i]) - double(b.data[i]));
    values += double(b.data[i]);
  }
  REQUIRE(values > 0);
  return differences / values;
}
/// Where two surfaces are equally near, the order in which they are looked at decides, which the
/// acceleration structure of a scene that moves may change: of single paths, and of the pilot by
/// which a method weighs all of them.
constexpr double kTies = 5e-3;

double mean(const Image& image) {
  double sum = 0;
  for (const float v : image.data) sum += double(v);
  return sum / double(image.data.size());
}

void check_same(const std::string& content, const std::string& method) {
  CAPTURE(method);
  const Described d(content);
  const SampleRange range{SampleSequence::sobol, 5, 0, 0, 6};
  CHECK(difference(moving_image(d, method, range), still_image(d, method, range)) < kTies);
}

}  // namespace

TEST_CASE("posing a scene is the same as building it anew, whatever moves") {
  const std::string flat =
      "<shape type='rectangle'>" + kGlow +
      animation("<rotate x='1' angle='180'/><scale value='0.2'/><translate z='1.8'/>",
                "<rotate x='1' angle='100'/><scale value='0.4'/><translate y='0.8' z='1.5'/>") +
      "</shape>";
  const std::string no_surfaces =
      "<emitter type='point'>" + kWay + "</emitter><emitter type='spot'>" +
      animation("<rotate x='1' angle='180'/><translate z='1.8'/>",
                "<rotate x='1' angle='140'/><translate x='0.5' z='1.8'/>") +
      "</emitter><emitter type='directional'>" +
      animation("<rotate x='1' angle='-90'/>", "<rotate x='1' angle='-40'/>") + "</emitter>";
  struct Case {
    const char* name;
    std::string content;
  };
  const Case cases[] = {
      {"an instance", kStillCamera + kRoom + kLamp + kMovingInstance},
      {"a sensor", kMovingCamera + kRoom + kLamp},
      {"a sphere that shines", kStillCamera + kRoom + moving_shape("sphere", kGlow)},
      {"meshes that shine", kStillCamera + kRoom + moving_shape("cube", kGlow) + flat},
      {"lights without a surface", kStillCamera + kRoom + no_surfaces},
      {"all at once",
       kMovingCamera + kRoom + kLamp + kMovingInstance + moving_shape("cylinder", kGlow) + flat}};
  for (const Case& c : cases)
    for (const char* method : {"path", "bdpt", "vcm"}) {
      CAPTURE(c.name);
      check_same(c.content, method);
    }
}

TEST_CASE("an environment turns, and smooth normals go with a mesh that shines") {
  const TemporaryDirectory folder;
  Image sky(8, 4, {"R", "G", "B"});
  for (size_t i = 0; i < sky.data.size(); ++i) sky.data[i] = float(1 + 7 * i % 13);
  write_exr(folder.path("sky.exr"), sky, {});
  folder.write("bent.obj",
               "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvn -1 0 1\nvn 1 0 1\nvn 0 1 1\nf 1//1 2//2 3//3\n");
  const std::string file = folder.write(
      "scene.xml", "<scene version='0.6.0'>" + kStillCamera +
                       "<shape type='obj'><string name='filename' value='bent.obj'/>" +
                       grey("0.7") + kGlow +
                       animation("<rotate x='1' angle='90'/><translate y='1' z='1'/>",
                                 "<rotate x='1' angle='60'/><translate y='1' z='0.5'/>") +
                       "</shape><emitter type='envmap'><string name='filename' value='sky.exr'/>" +
                       animation("<rotate x='1' angle='90'/>", "<rotate x='1' angle='20'/>") +
                       "</emitter></scene>");
  Diagnostics diagnostics;
  const auto read = read_mitsuba(file, {}, diagnostics);
  REQUIRE(read);
  Described d(kStillCamera);
  d.description = read->description;
  const SampleRange range{SampleSequence::sobol, 5, 0, 0, 4};
  for (const char* method : {"path", "bdpt"})
    CHECK(difference(moving_image(d, method, range), still_image(d, method, range)) < 1e-4);
}

TEST_CASE("lights go from one medium to another, and media go with their shapes") {
  const std::string smoke =
      "<medium name='interior' type='homogeneous'><rgb name='sigmaS' value='1.5'/><rgb "
      "name='sigmaA' value='0.1'/></medium>";
  const std::string still =
      "<shape type='sphere'><point name='center' x='0' y='0' z='1'/><float "
      "name='radius' value='0.8'/>" +
      smoke + "</shape>";
  check_same(kStillCamera + kRoom + still + "<emitter type='point'>" + kWay + "</emitter>",
             "volpath");
  check_same(kStillCamera + kRoom + still + "<emitter type='point'>" + kWay + "</emitter>", "bdpt");
  const Described d(kStillCamera + kRoom + kLamp + moving_shape("sphere", smoke));
  const SampleRange range{SampleSequence::sobol, 5, 0, 0, 64};
  const Image moving = moving_image(d, "volpath", range),
              standing = still_image(d, "volpath", range);
  // The sphere is an instance here and none there: rounding sends a few paths another way.
  CHECK(std::abs(mean(moving) / mean(standing) - 1) < 0.01);
}

TEST_CASE("meters move, and stand on shapes that do") {
  const std::string film =
      "<film type='hdrfilm'><integer name='width' value='1'/><integer name='height' value='1'/>"
      "<rfilter type='box'/></film>";
  const std::string shutter = "<float name='shutterClose' value='2'/>";
  const std::string light = kLamp + "<integrator type='path'/>";
  check_same(light + kRoom + "<shape type='cube'>" + kWay + "<sensor type='irradiancemeter'>" +
                 shutter + film + "</sensor></shape>",
             "path");
  check_same(light + kRoom + "<sensor type='fluencemeter'>" + shutter + film +
                 animation("<translate z='0.2'/>", "<translate z='1' x='0.5'/>") + "</sensor>",
             "path");
}

TEST_CASE("the image is the mean over the time that the shutter is open") {
  struct Case {
    const char* name;
    std::string content;
  };
  const Case cases[] = {
      {"an ordinary shape", kStillCamera + kRoom + kLamp + moving_shape("cube", grey("0.9"))},
      {"a sensor", kMovingCamera + kRoom + kLamp + sphere_xml("0 0 0.5", "0.4", "")},
      {"a light", kStillCamera + kRoom + moving_shape("sphere", kGlow)}};
  constexpr int kBatches = 24, kSamples = 12;
  for (const Case& c : cases)
    for (const char* method : {"path", "bdpt", "vcm"}) {
      CAPTURE(c.name);
      CAPTURE(method);
      const Described d(c.content);
      TileBatches moving, standing, one_moment;
      for (uint64_t b = 0; b < kBatches; ++b) {
        moving.add(moving_image(d, method, {SampleSequence::sobol, 2 * b, 0, 0, kSamples}));
        // Times that owe nothing to the renderer: one in each of equal parts of the time.
        Sampler random(SampleSequence::independent, b, 0, 77);
        random.start_sample(0);
        std::vector<double> times;
        for (int i = 0; i < kSamples; ++i)
          times.push_back((i + double(random.next_1d())) / kSamples);
        const auto any_order = [&](uint32_t sample, uint32_t) {
          return times[(5 * sample + b) % kSamples];
        };
        const SampleRange other{SampleSequence::sobol, 2 * b + 1, 0, 0, kSamples};
        standing.add(still_image(d, method, other, {}, any_order));
        if (method == std::string("path"))
          one_moment.add(still_image(d, method, other, {}, [](auto, auto) { return 0.5; }));
      }
      const TileComparison t = compare_tiles(moving, standing);
      CAPTURE(t.rejected);
      CAPTURE(t.mean_z2);
      CAPTURE(t.ratio);
      CHECK(t.equal());
      CHECK(std::abs(t.ratio - 1) < 4 * t.ratio_error);
      // The test would notice if there were no motion.
      if (method == std::string("path")) CHECK(!compare_tiles(moving, one_moment).equal());
    }
}

TEST_CASE("neighbouring pixels see a sample at different times") {
  // A wide bar of light that crosses the image: at one time for all pixels, four samples are four
  // bars. Of 8 × 8 pixels that see different times the mean is near the true one.
  const std::string bar = "<scale x='0.6' y='2'/><rotate x='1' angle='90'/>";
  const Described d(kStillCamera + "<shape type='rectangle'>" + kGlow +
                    animation(bar + "<translate x='-1' z='1'/>", bar + "<translate x='1' z='1'/>") +
                    "</shape>");
  const auto blocks = [](const Image& image) {
    std::vector<double> sums(4);
    for (int y = 0; y < kMovingSize; ++y)
      for (int x = 0; x < kMovingSize; ++x)
        sums[size_t(y / 8 * 2 + x / 8)] += double(image.pixel(x, y)[0]);
    return sums;
  };
  const std::vector<double> truth =
      blocks(moving_image(d, "path", {SampleSequence::sobol, 1, 0, 0, 4096}));
  for (const char* method : {"path", "volpath", "direct", "bdpt", "ptracer", "reuse"}) {
    CAPTURE(method);
    REQUIRE(phases_of(d, method, {}).count(0) == PixelPhases::kMost);
    double squares = 0, squares_whole = 0;
    for (uint64_t seed = 2; seed < 22; ++seed) {
      const SampleRange range{SampleSequence::sobol, seed, 0, 0, 4};
      const auto time = [&](uint32_t sample, uint32_t phase) {
        return time_of_sample(range, sample, phase);
      };
      const std::vector<double> some = blocks(moving_image(d, method, range)),
                                whole = blocks(still_image(d, method, range, {}, time));
      for (size_t i = 0; i < truth.size(); ++i) {
        squares += std::pow(some[i] - truth[i], 2);
        squares_whole += std::pow(whole[i] - truth[i], 2);
      }
    }
    CHECK(squares < 0.3 * squares_whole);
  }
  for (const char* method : {"vcm", "ppm"}) CHECK(phases_of(d, method, {}).count(0) == 1);
}

TEST_CASE("the more samples there are, the fewer times each of them sees") {
  for (const uint32_t sample : {0u, 7u}) CHECK(phases_of_sample(sample, 16) == 16);
  for (const uint32_t sample : {8u, 15u}) CHECK(phases_of_sample(sample, 16) == 8);
  CHECK(phases_of_sample(16, 16) == 4);
  CHECK(phases_of_sample(63, 16) == 2);
  for (const uint32_t sample : {64u, 127u, 128u, ~0u}) CHECK(phases_of_sample(sample, 16) == 1);
  CHECK(phases_of_sample(0, 4) == 4);
  CHECK(phases_of_sample(31, 4) == 4);
  CHECK(phases_of_sample(32, 4) == 2);
  // What takes long to pose is not posed more often.
  const std::string many = "<shape type='sphere'><float name='radius' value='0.01'/></shape>";
  std::string content = kStillCamera + kMovingInstance;
  for (int i = 0; i < 100; ++i) content += many;
  CHECK(phases_of(Described(content), "path", {}).count(0) == 2);
}

TEST_CASE("times are even over seeds and over samples, and go with no number of a pixel") {
  // Of one sample over seeds, so that every mean is right.
  for (const uint32_t sample : {0u, 1u, 5u, 70000u}) {
    std::vector<double> counts(20), expected(20, 200);
    for (uint64_t seed = 0; seed < 4000; ++seed) {
      const double t = time_of_sample({SampleSequence::sobol, seed, 3, 0, 1}, sample, 2);
      REQUIRE((t >= 0 && t < 1));
      ++counts[size_t(t * 20)];
    }
    CHECK(chi2_test(counts, expected, 0.001).pass);
  }
  // Of one seed: one in each stratum, and even together with each of the first numbers of a pixel.
  const SampleRange range{SampleSequence::sobol, 11, 0, 0, 1};
  std::vector<int> strata(16);
  for (uint32_t i = 0; i < 16; ++i) ++strata[size_t(16 * time_of_sample(range, i, 1))];
  CHECK(*std::max_element(strata.begin(), strata.end()) == 1);
  for (int dimension = 0; dimension < 20; ++dimension) {
    CAPTURE(dimension);
    constexpr int n = 4096;
    std::vector<double> counts(64), expected(64, n / 64.0);
    Sampler pixel(SampleSequence::sobol, 11, 0, 1234);
    for (uint32_t i = 0; i < n; ++i) {
      pixel.start_sample(i);
      pixel.start_dimension(uint32_t(dimension));
      ++counts[size_t(8 * time_of_sample(range, i, 1)) * 8 + size_t(8 * pixel.next_1d())];
    }
    double chi2 = 0;
    for (size_t k = 0; k < 64; ++k)
      chi2 += (counts[k] - expected[k]) * (counts[k] - expected[k]) / expected[k];
    CHECK(chi2 < 120);
  }
}

TEST_CASE("a closed shutter is one moment, bit for bit") {
  const std::string view = "<transform name='toWorld'>" + kView + "</transform>";
  const auto closed = [&](const std::string& content) {
    std::string text = camera(view) + kRoom + kLamp + content;
    const std::string close = "<float name='shutterClose' value='3'/>";
    return text.replace(text.find(close), close.size(), "<float name='shutterClose' value='1.5'/>");
  };
  const TransportScene moving(
      closed("<shape type='cube'>" + animation("<translate x='-1'/>", "<translate x='1' z='1'/>") +
             "</shape>"),
      "0.6.0");
  CHECK(!moving.scene->motion);
  const TransportScene still(closed("<shape type='cube'><transform name='toWorld'><translate "
                                    "x='-0.5' z='0.25'/></transform></shape>"),
                             "0.6.0");
  for (const char* method : {"path", "vcm"})
    CHECK(moving.render(method, {}, 4, 3).image.data == still.render(method, {}, 4, 3).image.data);
  // So is one that is open while nothing moves.
  const TransportScene before(
      kStillCamera + kRoom + kLamp +
          "<shape type='cube'><animation name='toWorld'><transform time='7'/><transform "
          "time='8'><translate x='1'/></transform></animation></shape>",
      "0.6.0");
  CHECK(!before.scene->motion);
}

TEST_CASE("moving scenes do not depend on threads, and every limit stops them") {
  const TransportScene scene(
      kMovingCamera + kRoom + kLamp + kMovingInstance + moving_shape("sphere", kGlow), "0.6.0");
  REQUIRE(scene.scene->motion);
  for (const char* method : {"path", "bdpt", "ppm", "vcm", "auto"}) {
    CAPTURE(method);
    const Image one = scene.render(method, {}, 5, 8, 1).image;
    CHECK(scene.render(method, {}, 5, 8, 3).image.data == one.data);
    CHECK(scene.render(method, {}, 5, 9, 1).image.data != one.data);
  }
  const auto integrator = scene.method("path", {});
  RenderRequest request;
  request.budget.target_error = 0.2;
  RenderResult r = duet::render(*scene.scene, *integrator, scene.layout, request);
  REQUIRE(r.relative_rmse);
  CHECK(*r.relative_rmse <= 0.2);
  request.threads = 3;
  CHECK(duet::render(*scene.scene, *integrator, scene.layout, request).image.data == r.image.data);
  request = {};
  request.budget.seconds = 0.05;
  CHECK(duet::render(*scene.scene, *integrator, scene.layout, request).spp >= 1);
  std::atomic<bool> cancel = false;
  double done = 0;
  request = {};
  request.budget.spp = 1 << 20;
  request.cancel = &cancel;
  request.progress = [&](const RenderProgress& p) {
    CHECK(p.fraction >= done);
    done = p.fraction;
    cancel = true;
  };
  r = duet::render(*scene.scene, *integrator, scene.layout, request);
  CHECK(r.interrupted);
}

TEST_CASE("a scene that moves is refused to a second render at the same time") {
  const TransportScene scene(kMovingCamera + kRoom + kLamp + kMovingInstance, "0.6.0");
  SceneMotion* const motion = scene.scene->motion.get();
  REQUIRE(motion);
  const auto in_another_thread = [&](const auto& use) {
    std::string message;
    std::thread([&] {
      try {
        use();
      } catch (const std::runtime_error& e) {
        message = e.what();
      }
    }).join();
    return message;
  };
  const auto begin = [&] { scene.method("auto", {})->begin(*scene.scene, {{8, 8}, 1, 1}); };
  // What another render does, in the middle of one.
  std::string from_begin, from_render;
  RenderRequest request;
  request.budget.spp = 2;
  request.wants_snapshot = [] { return true; };
  request.snapshot = [&](const RenderResult&) {
    from_begin = in_another_thread(begin);
    from_render = in_another_thread([&] { scene.render("path", {}, 1, 1, 1); });
  };
  const auto integrator = scene.method("auto", {});
  const Image image = duet::render(*scene.scene, *integrator, scene.layout, request).image;
  for (const std::string& message : {from_begin, from_render})
    CHECK(
        message.starts_with("the scene moves while its shutter is open and is being rendered "
                            "already"));
  CHECK(image.data == scene.render("auto", {}, 2, 0, 1).image.data);
  {
    const MotionLease lease(motion), again(motion);
    CHECK(!in_another_thread(begin).empty());
    CHECK(scene.render("path", {}, 1, 1, 1).spp == 1);
    CHECK(!in_another_thread(begin).empty());
  }
  CHECK(in_another_thread(begin).empty());
  // Scenes that stand still are anybody's.
  const MotionLease still(nullptr);
  CHECK(in_another_thread([] { const MotionLease other(nullptr); }).empty());
}
