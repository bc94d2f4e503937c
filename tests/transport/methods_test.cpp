// What all bidirectional methods promise about their images, whatever is in them.
#include <algorithm>
#include <cmath>

#include "support/statistics.h"
#include "support/transport_scene.h"
#include "transport/merge_mask.h"

using namespace duet;
using namespace duet::test;

namespace {

const char* const kMethods[] = {"ptracer", "bdpt", "reuse", "ppm", "bpm", "vcm"};

TransportScene glass_room() {
  const std::string lens =
      "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='3'/>";
  return TransportScene(
      camera_xml("0, -3, 1", "0, 0, 1", 24, "thinlens", lens) + room_xml(grey("0.6")) +
      lamp_xml("0.4", "5") +
      "<emitter type='point'><point name='position' value='0.5, 0, 1.5'/></emitter>"
      "<emitter type='constant'><rgb name='radiance' value='0.3'/></emitter>" +
      sphere_xml("-0.4, 0, 0.6", "0.4", "<bsdf type='dielectric'/>") +
      sphere_xml("0.5, 0, 0.5", "0.35", "<bsdf type='plastic'/>"));
}

/// A lamp in a bulb, and beside it a ball, in a room of grey walls or of the ball's BSDF.
TransportScene bulb_room(const std::string& bulb, const std::string& ball, bool grey_walls) {
  return TransportScene(
      camera_xml("0, -3, 1", "0, 0, 1", 16) + room_xml(grey_walls ? grey("0.6") : ball) +
      sphere_xml("0, 0, 1.2", "0.06",
                 "<emitter type='area'><rgb name='radiance' value='60'/></emitter>") +
      "<emitter type='point'><point name='position' value='0.7, -0.3, 1.8'/></emitter>" +
      sphere_xml("0, 0, 1.2", "0.3", bulb) + sphere_xml("0.5, 0, 0.4", "0.35", ball));
}
std::string rough(const std::string& type, const std::string& alpha) {
  return "<bsdf type='" + type + "'><float name='alpha' value='" + alpha + "'/></bsdf>";
}

}  // namespace

TEST_CASE("images of bidirectional methods do not depend on the number of threads") {
  const TransportScene scene = glass_room();
  for (const char* name : kMethods) {
    CAPTURE(name);
    const auto one = scene.render(name, {{"max_depth", "6"}}, 3, 5, 1).image.data;
    for (const int threads : {2, 7})
      CHECK(scene.render(name, {{"max_depth", "6"}}, 3, 5, threads).image.data == one);
    CHECK(scene.render(name, {{"max_depth", "6"}}, 3, 6, 2).image.data != one);
  }
}

// Limits that no path reaches leave the weights of bdpt, which are computed from running sums and
// not from the vertex pdfs that a light pass keeps. Differences in a thousandth of one path in a
// thousand would be seen.
TEST_CASE("path reuse without limits is bdpt with the same samples, in media, too") {
  for (const char* name : {"cornell-box", "media-homogeneous", "media-boundaries"}) {
    CAPTURE(name);
    const TransportScene scene(name, 16);
    TransportScene::Parameters p{{"max_depth", "7"}, {"rr_depth", "64"}, {"light_paths", "1"}};
    const Image bdpt = scene.render("bdpt", p, 8, 5).image;
    p.insert(p.end(), {{"max_eye_depth", "64"}, {"max_light_depth", "64"}});
    const Image reuse = scene.render("reuse", p, 8, 5).image;
    double difference = 0, sum = 0;
    for (size_t i = 0; i < bdpt.data.size(); ++i) {
      difference += std::abs(double(bdpt.data[i]) - double(reuse.data[i]));
      sum += bdpt.data[i];
    }
    CHECK(sum > 0);
    CHECK(difference < 1e-6 * sum);
  }
}

TEST_CASE("images of bidirectional methods do not depend on what was rendered before") {
  const TransportScene scene = glass_room();
  for (const char* name : kMethods) {
    CAPTURE(name);
    const auto integrator = scene.method(name, {{"max_depth", "6"}});
    scene.render(*integrator, scene.layout, 3, 6);
    CHECK(scene.render(*integrator, scene.layout, 3, 5).image.data ==
          scene.render(name, {{"max_depth", "6"}}, 3, 5, 1).image.data);
  }
}

TEST_CASE("a crop window of a bidirectional method is cut out of the full image, splats and all") {
  const TransportScene scene = glass_room();
  const PixelBounds crop{5, 9, 17, 20};
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::lanczos})
    for (const char* name : kMethods) {
      CAPTURE(name);
      FilmLayout layout = scene.layout;
      layout.filter = {};
      layout.filter.kind = kind;
      const auto integrator = scene.method(name, {{"max_depth", "4"}});
      const Image full = scene.render(*integrator, layout, 4, 2).image;
      layout.crop = crop;
      const Image part = scene.render(*integrator, layout, 4, 2).image;
      bool same = true;
      for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
          for (int c = 0; c < 4; ++c)
            same &= part.data[size_t(y * part.width + x) * 4 + size_t(c)] ==
                    full.data[size_t((y + crop.y0) * full.width + x + crop.x0) * 4 + size_t(c)];
      CHECK(same);
    }
}

TEST_CASE("layers of techniques add up to the image") {
  const TransportScene scene =
      bulb_room(rough("roughdielectric", "0.03"), rough("roughconductor", "0.02"), true);
  for (const char* name : kMethods) {
    CAPTURE(name);
    const auto integrator = scene.method(name, {{"max_depth", "5"}}, TechniqueOutput::weighted);
    const Image image = scene.render(*integrator, scene.layout, 4, 2).image;
    const size_t stride = image.channels.size();
    REQUIRE(stride > 7);
    double worst = 0;
    for (size_t i = 0; i < image.data.size(); i += stride)
      for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (size_t k = 4 + c; k < stride; k += 3) sum += double(image.data[i + k]);
        worst = std::max(
            worst, std::abs(sum - double(image.data[i + c])) / (0.01 + double(image.data[i + c])));
      }
    CHECK(worst < 1e-4);
  }
  CHECK_THROWS_AS(scene.method("path", {}, TechniqueOutput::weighted), std::invalid_argument);
  CHECK_THROWS_AS(scene.method("bdpt", {}, TechniqueOutput::weighted), std::invalid_argument);
}

// Under this sky hardly any light sub-path meets the two balls, which are tiny beside the scene.
TEST_CASE(
    "without light vertices there are no connections, and without connections no layers of them") {
  const TransportScene scene(camera_xml("0, -0.2, 0", "0, 0, 0", 16) +
                             "<emitter type='constant'><rgb name='radiance' value='1'/></emitter>" +
                             sphere_xml("-0.01, 0, 0", "0.01", grey("0.8")) +
                             sphere_xml("0.01, 0, 0", "0.01", grey("0.8")) +
                             sphere_xml("0, 9, 0", "0.001", grey("0.8")));
  const auto bdpt = [&](const std::string& connections) {
    return scene.render("bdpt", {{"connections", connections}, {"max_depth", "4"}}, 16, 1).image;
  };
  CHECK(bdpt("2").data == bdpt("0").data);
  CHECK(bdpt("-1").data != bdpt("0").data);
  const auto layers = [&](const std::string& connections) {
    const auto integrator = scene.method("bdpt", {{"connections", connections}, {"max_depth", "4"}},
                                         TechniqueOutput::weighted);
    return integrator->channels();
  };
  const auto has = [&](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  CHECK(has(layers("2"), "s2t2.R"));
  CHECK(!has(layers("0"), "s2t2.R"));
  for (const char* name : {"s0t3.R", "s1t3.R", "s2t1.R"}) CHECK(has(layers("0"), name));
}

TEST_CASE("where vcm merges it is vcm, and elsewhere bdpt") {
  const TransportScene scene = glass_room();
  const auto image = [&](BidirectionalMethod method, const std::vector<uint8_t>& parts) {
    BidirectionalIntegratorDescription d;
    d.method = method;
    d.max_depth = 6;
    d.light_paths = 1;
    d.radius = 0.05;
    d.merge_parts = parts;
    IntegratorDescription description;
    description.method = d;
    const auto integrator = make_integrator(description);
    return scene.render(*integrator, scene.layout, 4, 2).image;
  };
  constexpr size_t kParts = size_t(MergeMask::kSide * MergeMask::kSide);
  const Image vcm = image(BidirectionalMethod::vcm, {}),
              bdpt = image(BidirectionalMethod::bdpt, {});
  std::vector<uint8_t> right(kParts, 0);
  for (size_t i = 0; i < kParts; ++i) right[i] = i % MergeMask::kSide >= MergeMask::kSide / 2;
  const Image everywhere = image(BidirectionalMethod::vcm, std::vector<uint8_t>(kParts, 1)),
              nowhere = image(BidirectionalMethod::vcm, std::vector<uint8_t>(kParts, 0)),
              half = image(BidirectionalMethod::vcm, right);
  // They have the random numbers in common: all but rounding is the same, except that the roulette
  // of a light sub-path draws others once a vertex is weighed otherwise on the other side.
  size_t different = 0, different_halves = 0, merged = 0;
  for (size_t i = 0; i < vcm.data.size(); ++i) {
    const auto differ = [&](const Image& a, const Image& b) {
      return std::abs(a.data[i] - b.data[i]) > 1e-3f * (0.1f + b.data[i]);
    };
    different += differ(everywhere, vcm) || differ(nowhere, bdpt);
    different_halves += differ(half, i / 4 % 24 >= 12 ? vcm : bdpt);
    merged += differ(vcm, bdpt);
  }
  CHECK(different < vcm.data.size() / 500);
  CHECK(different_halves < vcm.data.size() / 40);
  CHECK(merged > vcm.data.size() / 3);
}

namespace {

/// Means of images with different seeds.
Moments means(const TransportScene& scene, const std::string& method,
              const TransportScene::Parameters& parameters, int spp, int images) {
  Moments m;
  for (int seed = 0; seed < images; ++seed) {
    const Image image = scene.render(method, parameters, spp, uint64_t(seed)).image;
    double sum = 0;
    for (size_t i = 0; i < image.data.size(); i += 4)
      sum += double(image.data[i] + image.data[i + 1] + image.data[i + 2]);
    m.add(sum);
  }
  return m;
}

}  // namespace

TEST_CASE("nothing is merged on nearly specular surfaces") {
  const TransportScene sharp =
      bulb_room(rough("roughdielectric", "0.005"), rough("roughconductor", "0.04"), false);
  const TransportScene::Parameters p{{"max_depth", "5"}, {"light_paths", "1"}};
  TransportScene::Parameters merging = p;
  merging.push_back({"radius", "0.1"});
  const RenderResult vcm = sharp.render("vcm", merging, 4, 1), bdpt = sharp.render("bdpt", p, 4, 1);
  CHECK(vcm.image.data == bdpt.image.data);
  for (const char* name : {"ppm", "bpm", "vcm"}) {
    CAPTURE(name);
    CHECK(sharp.render(name, merging, 2, 1).counters.merges == 0);
    const TransportScene blunt =
        bulb_room(rough("roughdielectric", "0.06"), rough("roughconductor", "0.06"), false);
    CHECK(blunt.render(name, merging, 2, 1).counters.merges > 100);
  }
}

// Merging at the bulb itself makes ppm and bpm more than 20 % too dark here.
TEST_CASE("light of a nearly specular bulb is as bright with merging as without") {
  const TransportScene scene = bulb_room(rough("roughdielectric", "0.005"), grey("0.5"), true);
  const Moments exact = means(scene, "bdpt", {{"max_depth", "6"}}, 256, 8);
  for (const char* name : {"ppm", "bpm", "vcm"}) {
    CAPTURE(name);
    const Moments merged = means(
        scene, name, {{"max_depth", "6"}, {"radius", "0.02"}, {"alpha", "1"}, {"light_paths", "4"}},
        48, 8);
    const double error = std::hypot(merged.error(), exact.error()) / exact.mean();
    CHECK(error < 0.012);
    CHECK(std::abs(merged.mean() / exact.mean() - 1) < 0.01 + 3 * error);
  }
}

// Merging on the coat itself makes the images of ppm and bpm noisy beyond use here.
TEST_CASE("merging on plastic with a sharp coat leaves its highlights alone") {
  const std::string plastic = rough("roughplastic", "0.005");
  const TransportScene scene(camera_xml("0, -3, 1", "0, 0, 1", 16) + room_xml(plastic) +
                             lamp_xml("0.2", "30") + sphere_xml("0, 0, 0.5", "0.4", plastic));
  const Moments exact = means(scene, "bdpt", {{"max_depth", "6"}}, 128, 8);
  for (const char* name : {"ppm", "bpm", "vcm"}) {
    CAPTURE(name);
    const Moments merged = means(
        scene, name, {{"max_depth", "6"}, {"radius", "0.02"}, {"alpha", "1"}, {"light_paths", "4"}},
        32, 8);
    const double error = std::hypot(merged.error(), exact.error()) / exact.mean();
    CHECK(error < 0.012);
    CHECK(std::abs(merged.mean() / exact.mean() - 1) < 0.01 + 3 * error);
  }
}

TEST_CASE("splats are as bright at the border of the image as within it") {
  // A white plane under a white sky: every pixel is 1.
  const TransportScene scene(camera_xml("0, 0, 3", "0, 0.001, 0", 24) +
                             "<shape type='rectangle'><transform name='to_world'><scale value='2'/>"
                             "</transform><bsdf type='diffuse'><rgb name='reflectance' value='1'/>"
                             "</bsdf></shape><emitter type='constant'/>");
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::mitchell}) {
    FilmLayout layout = scene.layout;
    layout.filter = {};
    layout.filter.kind = kind;
    Moments border, interior;
    for (uint64_t seed = 0; seed < 8; ++seed) {
      const auto integrator = scene.method("ptracer", {{"max_depth", "3"}, {"light_paths", "400"}});
      const Image image = scene.render(*integrator, layout, 1, seed).image;
      double sums[2] = {}, counts[2] = {};
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
          const bool at_border = x == 0 || y == 0 || x == 23 || y == 23;
          sums[at_border] += double(image.data[size_t(y * 24 + x) * 4]);
          ++counts[at_border];
        }
      interior.add(sums[0] / counts[0]);
      border.add(sums[1] / counts[1]);
    }
    CHECK(std::abs(border.mean() - 1) < 4 * border.error());
    CHECK(std::abs(interior.mean() - 1) < 4 * interior.error());
    // By how much a filter that is not cut off would be too dark is eight hundredths.
    CHECK(border.error() < 0.015);
  }
}

TEST_CASE("time and error limits stop bidirectional methods") {
  const TransportScene scene = glass_room();
  for (const char* name : {"ptracer", "bdpt", "vcm"}) {
    const auto integrator = scene.method(name, {{"max_depth", "4"}});
    RenderRequest request;
    request.threads = 2;
    request.budget.target_error = 0.2;
    const RenderResult result = render(*scene.scene, *integrator, scene.layout, request);
    REQUIRE(result.relative_rmse);
    CHECK(*result.relative_rmse <= 0.2);
    request.budget = {};
    request.budget.seconds = 0.2;
    CHECK(render(*scene.scene, *integrator, scene.layout, request).spp > 0);
  }
}

TEST_CASE("light sub-paths find all the light that a sphere of lamps sends out") {
  // Counters, not images: an open scene whose light sub-paths all leave at once.
  const TransportScene scene(camera_xml("0, -3, 0", "0, 0, 0", 8) +
                             sphere_xml("0, 0, 0", "0.5",
                                        "<emitter type='area'><rgb name='radiance' value='1'/>"
                                        "</emitter>"));
  const RenderResult r = scene.render("bdpt", {{"max_depth", "4"}, {"light_paths", "1"}}, 2, 1);
  CHECK(r.counters.light_paths == 2 * 64);
  CHECK(r.counters.connections.attempted() == 0);
  CHECK(r.counters.nonfinite_samples == 0);
  CHECK(r.image.data[(4 * 8 + 4) * 4] == doctest::Approx(1));
}
