// Ids and coverages of what is seen.
#include "integrators/matte_pass.h"

#include <doctest/doctest.h>

#include <bit>
#include <map>

#include "scene/build.h"
#include "scene/film_layout.h"
#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr uint32_t kSamples = 256;

/// A camera of parallel rays that sees the square from (−1, −1) to (1, 1) from above, in so many
/// pixels across and down.
std::string matte_view(int pixels) {
  const std::string size = std::to_string(pixels);
  return "<integrator type='path'/><sensor type='orthographic'><float name='shutterOpen' "
         "value='0'/>"
         "<float name='shutterClose' value='1'/><transform name='toWorld'>"
         "<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'>"
         "<integer name='width' value='" +
         size + "'/><integer name='height' value='" + size +
         "'/></film></sensor><emitter type='constant'/>";
}

class MatteScene {
 public:
  /// Of 2 × 2 pixels each is a unit wide.
  explicit MatteScene(const std::string& content, int pixels = 2) {
    ReadResult r = read_text("<scene version='0.6.0'>" + matte_view(pixels) + content + "</scene>");
    REQUIRE_MESSAGE(r.scene, r.messages());
    SceneDescription description = std::move(r.scene->description);
    layout_ = film_layout(description.sensors[0].film, std::nullopt, std::nullopt);
    name_unnamed(description);
    BuildOptions options;
    options.names = &names_;
    Diagnostics diagnostics;
    scene_ = build_scene(std::move(description), options, diagnostics);
    REQUIRE(scene_);
  }

  Image image(const MatteRequest& request) const {
    return render_mattes(*scene_, names_, layout_, request);
  }
  Image image(MatteKind kind) const {
    return image({.kinds = {kind}, .spp = kSamples, .threads = 2});
  }
  FilmLayout& layout() { return layout_; }
  const SceneNames& names() const { return names_; }

 private:
  std::unique_ptr<Scene> scene_;
  SceneNames names_;
  FilmLayout layout_;
};

/// Coverages by id, of the matte whose channels begin at `first`.
std::map<uint32_t, float> coverages(const Image& image, int x, int y, size_t first = 0) {
  std::map<uint32_t, float> found;
  const float* p = image.pixel(x, y) + first;
  float last = 1;
  for (size_t i = 0; i < kMatteRanks; ++i) {
    const float coverage = p[2 * i + 1];
    CHECK(coverage <= last);
    last = coverage;
    if (coverage > 0) found[std::bit_cast<uint32_t>(p[2 * i])] = coverage;
  }
  return found;
}

/// A square from (−1, −1) to (1, 1), moved.
std::string square(const std::string& id, const std::string& place, const std::string& inside) {
  return "<shape type='rectangle' id='" + id + "'><transform name='toWorld'>" + place +
         "</transform>" + inside + "</shape>";
}

const std::string kGrey = "<bsdf type='diffuse' id='grey'/>", kSameGrey = "<ref id='grey'/>";
const doctest::Approx kHalf = doctest::Approx(0.5).epsilon(0.02);

}  // namespace

TEST_CASE("a pixel that is half covered has half of the coverage, and the rest is what is behind") {
  // The edge of the upper square goes through the middle of the left pixels.
  const MatteScene scene(square("above", "<translate x='0.5' z='1'/>", kGrey) +
                         square("below", "", "<bsdf type='diffuse' id='white'/>"));
  const Image objects = scene.image(MatteKind::object);
  auto left = coverages(objects, 0, 0);
  CHECK(left.size() == 2);
  CHECK(left[matte_id("above")] == kHalf);
  CHECK(left[matte_id("below")] == kHalf);
  CHECK(left[matte_id("above")] + left[matte_id("below")] == 1);
  CHECK(coverages(objects, 1, 0) == std::map<uint32_t, float>{{matte_id("above"), 1.0f}});
  auto material = coverages(scene.image(MatteKind::material), 0, 1);
  CHECK(material[matte_id("grey")] == kHalf);
  CHECK(material[matte_id("white")] == kHalf);
  // Several kinds follow each other.
  const Image both = scene.image(
      {.kinds = {MatteKind::object, MatteKind::material}, .spp = kSamples, .threads = 1});
  CHECK(both.channels.size() == 4 * kMatteRanks);
  CHECK(coverages(both, 0, 0) == left);
  CHECK(coverages(both, 0, 1, 2 * kMatteRanks) == material);
}

TEST_CASE("where nothing is seen nothing is covered") {
  const MatteScene scene(square("alone", "<translate x='0.5'/>", kGrey));
  auto left = coverages(scene.image(MatteKind::object), 0, 0);
  CHECK(left.size() == 1);
  CHECK(left[matte_id("alone")] == kHalf);
}

TEST_CASE("what lets light straight through shows what is behind it, as often as it does") {
  const MatteScene scene(
      square(
          "veil", "<translate z='1'/>",
          "<bsdf type='mask'><float name='opacity' value='0.25'/><bsdf type='diffuse'/></bsdf>") +
      square("nothing", "<translate z='2'/>", "<bsdf type='null'/>") +
      square("glass", "", "<bsdf type='dielectric'/>"));
  auto seen = coverages(scene.image(MatteKind::object), 1, 1);
  CHECK(seen.size() == 2);
  CHECK(seen[matte_id("veil")] == doctest::Approx(0.25).epsilon(0.02));
  CHECK(seen[matte_id("glass")] == doctest::Approx(0.75).epsilon(0.02));
}

TEST_CASE("lights that the camera does not see are no part of a matte") {
  const MatteScene scene(square("lamp", "<translate z='1'/>", "<emitter type='area'/>") +
                         square("floor", "", kGrey));
  CHECK(coverages(scene.image(MatteKind::object), 0, 0) ==
        std::map<uint32_t, float>{{matte_id("lamp"), 1.0f}});
  MatteRequest request{.kinds = {MatteKind::object}, .spp = 4};
  request.hides_lights = true;
  CHECK(coverages(scene.image(request), 0, 0) ==
        std::map<uint32_t, float>{{matte_id("floor"), 1.0f}});
}

TEST_CASE("what moves is covered for as long as it is seen") {
  const std::string runner =
      "<shape type='rectangle' id='runner'>" + kGrey +
      "<animation name='toWorld'><transform time='0'><translate x='1'/></transform>"
      "<transform time='1'><translate x='3'/></transform></animation></shape>";
  const MatteScene scene(runner);
  // Its edge moves from the middle of the image to the right, and has left it at half of the time.
  auto right = coverages(scene.image(MatteKind::object), 1, 0);
  CHECK(right[matte_id("runner")] == doctest::Approx(0.25).epsilon(0.04));
  CHECK(coverages(scene.image(MatteKind::object), 0, 0).empty());
  // Pixels that see it at times of their own are covered as much on average.
  constexpr int kPixels = 32;
  const Image many = MatteScene(runner, kPixels).image(MatteKind::object);
  double sum = 0;
  for (int y = 0; y < kPixels; ++y)
    for (int x = kPixels / 2; x < kPixels; ++x)
      sum += double(coverages(many, x, y)[matte_id("runner")]);
  CHECK(sum / (kPixels * kPixels / 2) == doctest::Approx(0.25).epsilon(0.01));
}

TEST_CASE("instances have names of their own, or those of what they show") {
  const std::string group = "<shape type='shapegroup' id='group'>" +
                            square("part", "<scale value='0.5'/>", kGrey) + "</shape>";
  const auto instance = [](const std::string& id, double x) {
    return "<shape type='instance'" + id +
           "><ref id='group'/><transform name='toWorld'>"
           "<translate x='" +
           std::to_string(x) + "' y='0.5'/></transform></shape>";
  };
  const MatteScene scene(group + instance(" id='copy'", -0.5) + instance("", 0.5));
  const Image objects = scene.image(MatteKind::object);
  CHECK(coverages(objects, 0, 0) == std::map<uint32_t, float>{{matte_id("copy"), 1.0f}});
  CHECK(coverages(objects, 1, 0) == std::map<uint32_t, float>{{matte_id("part"), 1.0f}});
  CHECK(coverages(scene.image(MatteKind::material), 0, 0) ==
        std::map<uint32_t, float>{{matte_id("grey"), 1.0f}});
}

TEST_CASE("what has no name has one of its place in the file") {
  const MatteScene scene(square("first", "<translate x='9'/>", kGrey) +
                         "<shape type='rectangle'><bsdf type='diffuse'/></shape>");
  CHECK(scene.names().shapes == std::vector<std::string>{"first", "shape#1"});
  CHECK(scene.names().materials == std::vector<std::string>{"grey", "material#1"});
  CHECK(coverages(scene.image(MatteKind::object), 0, 0) ==
        std::map<uint32_t, float>{{matte_id("shape#1"), 1.0f}});
}

TEST_CASE("more things than ranks: those that cover most are kept") {
  std::string strips;
  // In the left upper pixel eight strips, each thinner than the one before.
  double edge = -1;
  for (int i = 0; i < 8; ++i) {
    const double width = 0.2 - 0.02 * i;
    strips += square("strip" + std::to_string(i),
                     "<scale x='" + std::to_string(width / 2) + "'/><translate x='" +
                         std::to_string(edge + width / 2) + "'/>",
                     i == 0 ? kGrey : kSameGrey);
    edge += width;
  }
  const auto seen = coverages(MatteScene(strips).image(MatteKind::object), 0, 0);
  CHECK(seen.size() == kMatteRanks);
  for (int i = 0; i < 5; ++i) CHECK(seen.contains(matte_id("strip" + std::to_string(i))));
}

TEST_CASE("mattes depend neither on the number of threads nor on the window") {
  MatteScene scene(square("above", "<rotate z='1' angle='20'/><translate x='-0.4' z='1'/>", kGrey) +
                   square("below", "<translate x='-0.3'/>", kSameGrey));
  MatteRequest request{.kinds = {MatteKind::object}, .spp = 19, .threads = 1};
  const Image one = scene.image(request);
  request.threads = 3;
  CHECK(scene.image(request).data == one.data);
  scene.layout().crop = {1, 0, 2, 1};
  const Image window = scene.image(request);
  REQUIRE(window.data.size() == 2 * kMatteRanks);
  CHECK(std::equal(window.data.begin(), window.data.end(), one.pixel(1, 0)));
}
