// Raw films: whatever parts a render was cut into, its image has the same bits.
#include "evaluate/raw/raw_film.h"

#include <algorithm>
#include <cstring>
#include <random>

#include "evaluate/raw/identity.h"
#include "evaluate/raw/merge.h"
#include "image/image_io.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kRoom =
    "<integrator type='path'><integer name='max_depth' value='5'/></integrator>" +
    camera_xml("0,-4,1", "0,0,1", 20) + room_xml(grey("0.6")) + lamp_xml("0.4", "9") +
    sphere_xml("0.3,0,0.4", "0.35", "<bsdf type='dielectric'/>");
const std::string kFog = sphere_xml(
    "-0.4,-0.2,0.6", "0.4",
    "<bsdf type='null'/><medium type='homogeneous' name='interior'><float name='sigma_t' "
    "value='3'/><float name='albedo' value='0.8'/></medium>");

/// A sphere that moves while the shutter is open.
const std::string kMoving =
    "<integrator type='path'><integer name='maxDepth' value='4'/></integrator>"
    "<sensor type='perspective'><float name='shutterOpen' value='0'/><float name='shutterClose' "
    "value='1'/><float name='fov' value='50'/><transform name='toWorld'><lookat origin='0,-3.5,1' "
    "target='0,0,1' up='0,0,1'/></transform><film type='hdrfilm'><integer name='width' value='16'/>"
    "<integer name='height' value='16'/><rfilter type='box'/></film></sensor>" +
    room_xml(grey("0.6")) +
    "<shape type='rectangle'><transform name='toWorld'><scale value='0.3'/><rotate x='1' "
    "angle='180'/><translate z='1.9'/></transform><emitter type='area'><rgb name='radiance' "
    "value='9'/></emitter></shape><shape type='sphere'><float name='radius' value='0.3'/>"
    "<animation name='toWorld'><transform time='0'><translate x='-0.6' z='0.4'/></transform>"
    "<transform time='1'><translate x='0.6' z='0.9'/></transform></animation></shape>";

/// What `auto` expects.
constexpr int kSpp = 24;

/// A way to render the room.
struct Way {
  std::string method;
  FilterKind filter = FilterKind::gaussian;
  std::vector<std::string> layers = {};
  TechniqueOutput techniques = TechniqueOutput::none;
  std::optional<PixelBounds> crop = {};
  bool fog = false, moves = false;
};

class RoomRender {
 public:
  explicit RoomRender(const Way& way)
      : scene_(way.moves ? TransportScene(kMoving, "0.6.0")
                         : TransportScene(kRoom + (way.fog ? kFog : ""))),
        layout_(scene_.layout),
        way_(way) {
    layout_.filter.kind = way.filter;
    if (way.crop) layout_.crop = *way.crop;
    const auto integrator = make();
    integrator->begin(*scene_.scene, {layout_.full, kSpp, 1});
    RenderRecord record;
    record.integrator = way.method;
    record.seed = 5;
    image = raw_image(record, *integrator, layout_);
    image.form = {layout_.crop, layout_.full, PixelFormat::rgba, false, {}, {}};
  }

  RenderRequest request(int spp, int threads = 1) const {
    RenderRequest r;
    r.budget.spp = spp;
    r.seed = 5;
    r.threads = threads;
    r.pass_seconds = 0.002;
    r.keeps_state = true;
    return r;
  }
  Image render(const RenderRequest& r, RenderState& state) const {
    return duet::render(*scene_.scene, *make(), layout_, r, state).image;
  }
  Image whole(int spp, int threads = 1) const {
    RenderState state;
    return render(request(spp, threads), state);
  }
  /// The raw film of these samples, as a file.
  std::string film(const TemporaryDirectory& folder, const SampleInterval& samples, int spp,
                   int threads) const {
    RenderRequest r = request(spp, threads);
    r.samples = samples;
    RenderState state;
    render(r, state);
    const std::string path = folder.path(to_string(samples) + ".exr");
    write_raw_film(path, image, state);
    return path;
  }

  RawImage image;

 private:
  std::unique_ptr<Integrator> make() const {
    IntegratorDescription d = scene_.integrator;
    apply_override(d, {way_.method, {}, way_.layers});
    return make_integrator(d, way_.techniques);
  }

  TransportScene scene_;
  FilmLayout layout_;
  Way way_;
};

const Way kWays[] = {
    {"path"},
    {"path", FilterKind::box, {"albedo", "variance", "moments", "samples"}},
    {"volpath", FilterKind::gaussian, {}, TechniqueOutput::none, {}, true},
    {"bdpt"},
    {"bdpt", FilterKind::box, {"variance"}, TechniqueOutput::weighted},
    {"bdpt", FilterKind::gaussian, {"samples"}, TechniqueOutput::none, PixelBounds{3, 5, 18, 13}},
    {"bdpt", FilterKind::box, {}, TechniqueOutput::none, {}, true},
    {"ptracer"},
    {"reuse", FilterKind::box},
    {"ppm"},
    {"bpm", FilterKind::box},
    {"vcm"},
    {"auto", FilterKind::box},
    {"vcm", FilterKind::box, {}, TechniqueOutput::none, {}, false, true},
};

void check_equal(const Image& a, const Image& b) {
  REQUIRE(a.data.size() == b.data.size());
  CHECK(std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0);
}

/// The state in a file.
RenderState state_of(const std::string& path) {
  RenderState state;
  RawFilm(path).add_to(state);
  return state;
}

}  // namespace

TEST_CASE("raw films: slices in any order, by any threads, are the whole image") {
  std::mt19937 random(1);
  for (const Way& way : kWays) {
    CAPTURE(way.method);
    const RoomRender room(way);
    const Image whole = room.whole(kSpp);
    check_equal(room.whole(kSpp, 7), whole);
    for (const uint32_t slices : {2u, 3u, 7u, 16u}) {
      const TemporaryDirectory folder;
      std::vector<std::string> files;
      for (uint32_t k = 1; k <= slices; ++k)
        files.push_back(room.film(folder, slice_of(kSpp, k, slices), kSpp, 1 + int(k % 3)));
      std::shuffle(files.begin(), files.end(), random);
      const MergedFilms merged = merge_raw_films(files);
      check_equal(merged.result.image, whole);
      CHECK(merged.result.spp == kSpp);
      CHECK(merged.gaps.empty());
    }
  }
}

TEST_CASE("raw films: more samples later are the same as at once") {
  for (const Way& way : kWays) {
    CAPTURE(way.method);
    const RoomRender room(way);
    const TemporaryDirectory folder;
    RenderState state = state_of(room.film(folder, {0, 6}, kSpp, 2));
    check_equal(room.render(room.request(kSpp, 2), state), room.whole(kSpp));
    CHECK(to_string(state.samples.all()) == "0:24");
    // Nothing is missing: nothing is done.
    const uint64_t paths = state.counters.camera_paths;
    check_equal(room.render(room.request(20), state), room.whole(kSpp));
    CHECK(state.counters.camera_paths == paths);
  }
}

TEST_CASE("raw films: a render to a target error goes on from any pass") {
  for (const std::string method : {"path", "bdpt"}) {
    CAPTURE(method);
    const RoomRender room({method, FilterKind::box});
    RenderRequest request = room.request(1, 2);
    request.budget.spp.reset();
    request.budget.target_error = method == "path" ? 0.04 : 0.08;
    const TemporaryDirectory folder;
    const std::string path = folder.path("film.exr");
    std::vector<std::string> films;
    int passes = 0;
    request.pass_seconds = 0;
    request.after_pass = [&](const RenderState& state) {
      // Of some passes, so that there are early and late ones.
      if (passes++ % 100 != 5 || films.size() > 3) return;
      films.push_back(folder.path(std::to_string(passes) + ".exr"));
      write_raw_film(films.back(), room.image, state);
    };
    RenderState state;
    const Image whole = room.render(request, state);
    REQUIRE(films.size() > 2);
    CHECK_FALSE(state.rounds.allocated.rates[0].empty());
    request.after_pass = nullptr;
    for (const std::string& film : films) {
      RenderState before = state_of(film);
      CHECK(before.spp < state.spp);
      check_equal(room.render(request, before), whole);
      CHECK(before.spp == state.spp);
    }
    // One that has met its target takes no more samples, and for a lower one those that follow.
    const std::string last = folder.path("last.exr");
    write_raw_film(last, room.image, state);
    RenderState after = state_of(last);
    check_equal(room.render(request, after), whole);
    CHECK(after.counters.camera_paths == state.counters.camera_paths);
    *request.budget.target_error *= 0.4;
    room.render(request, after);
    CHECK(after.spp > state.spp);
    if (method == "bdpt")
      for (size_t i = 0; i < after.films.size(); ++i)
        CHECK(after.films[i].passes() == int(after.rounds.allocated.taken[i].passes));
  }
}

TEST_CASE("raw films: the error of merged films is estimated") {
  const RoomRender room({"path", FilterKind::box});
  const TemporaryDirectory folder;
  RenderRequest request = room.request(64);
  RenderState state;
  room.render(request, state);
  const std::string whole = folder.path("whole.exr");
  write_raw_film(whole, room.image, state);
  const auto expected = merge_raw_films({whole}).result.relative_rmse;
  REQUIRE(expected);
  for (const uint32_t slices : {4u, 64u}) {
    std::vector<std::string> files;
    for (uint32_t k = 1; k <= slices; ++k)
      files.push_back(room.film(folder, slice_of(64, k, slices), 64, 1));
    const MergedFilms merged = merge_raw_films(files);
    REQUIRE(merged.result.relative_rmse);
    CHECK(*merged.result.relative_rmse == doctest::Approx(*expected).epsilon(0.2));
    CHECK(merged.state.counters.camera_paths == state.counters.camera_paths);
  }
}

TEST_CASE("raw films: gaps, overlaps and films of other images") {
  const RoomRender room({"path", FilterKind::box});
  const TemporaryDirectory folder;
  const std::string a = room.film(folder, {0, 3}, 8, 1), b = room.film(folder, {2, 4}, 8, 1),
                    c = room.film(folder, {6, 8}, 8, 1);
  const MergedFilms merged = merge_raw_films({c, a});
  CHECK(to_string(merged.gaps) == "3:6");
  CHECK(merged.result.spp == 5);
  const auto message = [](const std::vector<std::string>& files) {
    try {
      merge_raw_films(files);
    } catch (const ReadError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(message({a, b}) == b + ": the samples 2:4 overlap those of " + a + ", 0:3");
  CHECK(message({a, a}).find("overlap") != std::string::npos);

  RenderState state = state_of(c);
  const auto changed = [&](const auto& change) {
    RawImage other = room.image;
    change(other);
    const std::string path = folder.path("other.exr");
    write_raw_film(path, other, state);
    return message({a, path});
  };
  const std::string other = folder.path("other.exr") + ": is not of the same image: ";
  CHECK(changed([](RawImage& i) { i.seed = 6; }) == other + "\"seed\" is 6, not 5 as in " + a);
  CHECK(changed([](RawImage& i) { i.scene_hash = "abc"; }) ==
        other + "\"scene\" is \"abc\", not \"\" as in " + a);
  CHECK(changed([](RawImage& i) { i.integrator = "bdpt"; }).find("\"integrator\"") !=
        std::string::npos);
  CHECK(changed([](RawImage& i) { i.layout.full.x = 21; }).find("\"size\" is [21,20]") !=
        std::string::npos);
  CHECK(changed([](RawImage& i) { i.layout.filter.stddev = 2; }).find("\"filter\"") !=
        std::string::npos);
  CHECK(changed([](RawImage& i) {
          i.decision = MethodDecision{"vcm", "max_depth=4", "", {}};
        }).find("\"decision\"") != std::string::npos);
  CHECK(changed([](RawImage&) {}).empty());

  write_exr(folder.path("image.exr"), Image(4, 4, {"R", "G", "B"}), {});
  CHECK(message({a, folder.path("image.exr")}) ==
        folder.path("image.exr") + ": is no raw film of Duet");
  CHECK(message({folder.path("missing.exr")}).find("missing.exr") != std::string::npos);
}

TEST_CASE("raw films: a damaged file is never taken for a whole one") {
  const RoomRender room({"bdpt", FilterKind::box});
  const TemporaryDirectory folder;
  const std::string path = room.film(folder, {0, 2}, 2, 1), broken = folder.path("broken.exr");
  const std::string good = read_file(path);
  const Image whole = merge_raw_films({path}).result.image;
  const auto is_refused = [&](const std::string& bytes) {
    folder.write("broken.exr", bytes);
    try {
      const Image image = merge_raw_films({broken}).result.image;
      check_equal(image, whole);
      return false;
    } catch (const ReadError& e) {
      CHECK(std::string(e.what()).find(broken) != std::string::npos);
      return true;
    }
  };
  std::mt19937 random(2);
  size_t refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bytes = good;
    bytes[random() % bytes.size()] ^= char(1 << random() % 8);
    refused += is_refused(bytes);
  }
  // The others are where a file says what nobody asks.
  CHECK(refused > 300);
  for (int i = 0; i < 60; ++i) CHECK(is_refused(good.substr(0, random() % good.size())));
}
