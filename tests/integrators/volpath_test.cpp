// Light in media, where it can be computed by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "image/tile_test.h"
#include "support/show.h"
#include "support/statistics.h"
#include "support/transport_scene.h"
#include "support/volume_files.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Parallel rays towards +z through a square of side 2 around the origin.
std::string view(int size, const std::string& extra = "") {
  const std::string n = std::to_string(size);
  return "<sensor type='orthographic'>" + extra +
         "<transform name='to_world'><translate z='-5'/></transform><film type='hdrfilm'><integer "
         "name='width' value='" +
         n + "'/><integer name='height' value='" + n +
         "'/><rfilter type='box'/></film></sensor><integrator type='volpath'/>";
}

std::string homogeneous(const std::string& sigma_t, const std::string& albedo,
                        const std::string& phase = "") {
  return "<medium type='homogeneous' id='m'><rgb name='sigma_t' value='" + sigma_t +
         "'/><rgb name='albedo' value='" + albedo + "'/>" + phase + "</medium>";
}

const std::string kNull = "<bsdf type='null'/><ref id='m' name='interior'/>";
const std::string kWhiteSky = "<emitter type='constant'><rgb name='radiance' value='1'/></emitter>";
/// From z = 0 to 1, wider than anybody looks.
const std::string kSlab =
    "<shape type='cube'><transform name='to_world'><scale x='50' y='50' z='0.5'/><translate "
    "z='0.5'/></transform>" +
    kNull + "</shape>";

/// A medium of the same grey or coloured numbers at all nodes of a file on disk.
std::string constant_grid(const TemporaryDirectory& folder, const std::vector<float>& node,
                          const std::string& albedo, const std::string& to_world) {
  std::vector<float> values;
  for (int i = 0; i < 4 * 3 * 20; ++i) values.insert(values.end(), node.begin(), node.end());
  const std::string file =
      folder.write("grid.vol", float_volume(4, 3, 20, int(node.size()), values));
  return "<medium type='heterogeneous' id='m'><volume name='sigma_t' type='gridvolume'><string "
         "name='filename' value='" +
         file + "'/><transform name='to_world'>" + to_world +
         "</transform></volume><rgb name='albedo' value='" + albedo + "'/></medium>";
}

/// Mean of each channel over the image, with the spread of the pixels as its error.
struct Mean {
  Moments channel[3];
  explicit Mean(const Image& image) {
    for (size_t i = 0; i < image.data.size(); ++i)
      if (i % 4 < 3) channel[i % 4].add(double(image.data[i]));
  }
  void check(double r, double g, double b) const {
    const double expected[] = {r, g, b};
    for (int c = 0; c < 3; ++c) {
      CAPTURE(c);
      CAPTURE(channel[c].mean());
      CAPTURE(expected[c]);
      CHECK(std::abs(channel[c].mean() - expected[c]) <
            5 * channel[c].error() + 1e-4 * expected[c] + 1e-9);
      // An estimate so noisy that it proves nothing is no success.
      CHECK(channel[c].error() < 0.02 * expected[c] + 1e-6);
    }
  }
};

Mean render(const TransportScene& scene, int spp, TransportScene::Parameters parameters = {},
            const std::string& method = "volpath") {
  return Mean(scene.render(method, parameters, spp, 1).image);
}

}  // namespace

TEST_CASE("a slab that only absorbs lets through what Beer and Lambert say") {
  const TransportScene scene(view(8) + homogeneous("0.5 1 2", "0") + kSlab + kWhiteSky);
  for (const char* method : {"volpath", "volpathmis"})
    render(scene, 512, {}, method).check(std::exp(-0.5), std::exp(-1), std::exp(-2));
  // What passes straight through does not count, so that one segment is enough.
  render(scene, 512, {{"max_depth", "1"}}).check(std::exp(-0.5), std::exp(-1), std::exp(-2));
}

namespace {

/// Light along the line of sight, scattered once in a slab of thickness 2.
const std::string kLowSun =
    "<emitter type='directional'><vector name='direction' x='0' y='0' z='1'/><rgb "
    "name='irradiance' value='3'/></emitter>";
const std::string kPhase = "<phase type='hg'><float name='g' value='-0.3'/></phase>";
const double kBack = (1 - 0.09) / (4 * M_PI * std::pow(1 + 0.09 - 0.6, 1.5));

double once(double sigma_t, double albedo) {
  return 3 * kBack * albedo * (1 - std::exp(-2 * sigma_t)) / 2;
}

}  // namespace

TEST_CASE("light that is scattered once in a slab") {
  // Light falls along the line of sight: it has passed as much of the slab as is before it.
  const TransportScene scene(view(8) + homogeneous("0.5 1 4", "0.9 0.5 0.2", kPhase) + kSlab +
                             kLowSun);
  render(scene, 1024, {{"max_depth", "2"}}).check(once(0.5, 0.9), once(1, 0.5), once(4, 0.2));
  // The same from a grid.
  const TemporaryDirectory folder;
  const TransportScene grid(
      folder, view(8) +
                  constant_grid(folder, {0.5f, 1, 4}, "0.9 0.5 0.2",
                                "<translate x='-.5' y='-.5'/><scale x='99' y='99' z='1'/>") +
                  kSlab + kLowSun);
  const double turned = kBack * 4 * M_PI;  // isotropic here
  render(grid, 1024, {{"max_depth", "2"}})
      .check(once(0.5, 0.9) / turned, once(1, 0.5) / turned, once(4, 0.2) / turned);
}

TEST_CASE("sub-paths from both ends find the light that is scattered once in a slab") {
  // The sensor sees the middle of the slab, whose sides light does not reach in two segments.
  const std::string slab =
      "<shape type='cube'><transform name='to_world'><scale x='1.5' y='1.5' z='0.5'/><translate "
      "z='0.5'/></transform>" +
      kNull + "</shape>";
  const TransportScene scene(view(8) + homogeneous("0.5 1 4", "0.9 0.5 0.2", kPhase) + slab +
                             kLowSun);
  for (const auto& [method, effort] :
       {std::pair("bdpt", 1), {"reuse", 1}, {"vcm", 1}, {"ptracer", 4}}) {
    SHOW(method);
    render(scene, 512 * effort, {{"max_depth", "2"}, {"light_paths", "1"}}, method)
        .check(once(0.5, 0.9), once(1, 0.5), once(4, 0.2));
  }
}

TEST_CASE("a medium that only scatters cannot be seen in a furnace") {
  const std::string ball = "<shape type='sphere'>" + kNull + "</shape>";
  const std::string glass =
      "<shape type='sphere'><bsdf type='dielectric'/><ref id='m' name='interior'/></shape>";
  const std::string hg = "<phase type='hg'><float name='g' value='0.6'/></phase>";
  const TransportScene::Parameters patient{{"rr_depth", "1000000"}};
  render(TransportScene(view(8) + homogeneous("3", "1", hg) + ball + kWhiteSky), 256, patient)
      .check(1, 1, 1);
  render(TransportScene(view(8) + homogeneous("0.5 1 3", "1") + ball + kWhiteSky), 1024, patient)
      .check(1, 1, 1);
  // Radiance within glass is greater, and what comes out is not.
  render(TransportScene(view(8) + homogeneous("1", "1") + glass + kWhiteSky), 512, patient)
      .check(1, 1, 1);
  const TemporaryDirectory folder;
  render(TransportScene(folder, view(8) +
                                    constant_grid(folder, {1, 2, 3}, "1", "<scale value='0.8'/>") +
                                    ball + kWhiteSky),
         1024, patient)
      .check(1, 1, 1);
}

TEST_CASE("sub-paths from both ends cannot see a medium that only scatters in a furnace either") {
  const std::string ball = "<shape type='sphere'>" + kNull + "</shape>";
  const std::string hg = "<phase type='hg'><float name='g' value='0.6'/></phase>";
  const TransportScene grey(view(8) + homogeneous("3", "1", hg) + ball + kWhiteSky);
  const TransportScene coloured(view(8) + homogeneous("0.5 1 3", "1") + ball + kWhiteSky);
  const TransportScene lens(view(8) + homogeneous("1", "1") +
                            "<shape type='sphere'><bsdf type='dielectric'/><ref id='m' "
                            "name='interior'/></shape>" +
                            kWhiteSky);
  const TemporaryDirectory folder;
  const TransportScene grid(
      folder,
      view(8) + constant_grid(folder, {1, 2, 3}, "1", "<scale value='0.8'/>") + ball + kWhiteSky);
  for (const char* method : {"bdpt", "reuse", "vcm"})
    for (const TransportScene* scene : {&grey, &coloured, &lens, &grid}) {
      CAPTURE(method);
      render(*scene, 512, {{"rr_depth", "1000000"}, {"light_paths", "0.5"}}, method).check(1, 1, 1);
    }
}

TEST_CASE("a homogeneous medium and a grid of the same values give the same image") {
  const std::string lights =
      "<emitter type='point'><point name='position' value='0.5, 1.5, -2'/><rgb name='intensity' "
      "value='20 10 5'/></emitter>" +
      kWhiteSky;
  const std::string things =
      "<shape type='cube'><transform name='to_world'><scale value='0.8'/></transform>" + kNull +
      "</shape><shape type='sphere'><float name='radius' value='0.4'/></shape>" + lights;
  const TemporaryDirectory folder;
  const TransportScene even(view(16) + homogeneous("1.5 1.5 0.5", "0.9 0.5 0.8") + things);
  const TransportScene grid(
      folder, view(16) +
                  constant_grid(folder, {1.5f, 1.5f, 0.5f}, "0.9 0.5 0.8",
                                "<translate x='-.5' y='-.5' z='-.5'/><scale value='1.7'/>") +
                  things);
  const TransportScene::Parameters depth{{"max_depth", "6"}};
  const Image a = even.render("volpath", depth, 256, 3).image;
  const Image b = grid.render("volpath", depth, 256, 4).image;
  Moments difference[3];
  for (size_t i = 0; i < a.data.size(); ++i)
    if (i % 4 < 3) difference[i % 4].add(double(a.data[i]) - double(b.data[i]));
  const Mean mean(a);
  for (int c = 0; c < 3; ++c) {
    CHECK(std::abs(difference[c].mean()) < 5 * difference[c].error());
    CHECK(difference[c].error() < 0.01 * mean.channel[c].mean());
  }
}

TEST_CASE("a sensor within a medium, and a light around it") {
  const std::string shell =
      "<shape type='sphere'><point name='center' x='0' y='0' z='-5'/><float name='radius' "
      "value='2'/><boolean name='flip_normals' value='true'/><ref id='m' name='exterior'/><emitter "
      "type='area'><rgb name='radiance' value='1'/></emitter></shape>";
  const std::string sensor =
      "<sensor type='perspective'><ref id='m'/><float name='fov' value='40'/><float "
      "name='near_clip' value='1e-3'/><transform name='to_world'><translate "
      "z='-5'/></transform><film type='hdrfilm'><integer name='width' value='8'/><integer "
      "name='height' value='8'/><rfilter type='box'/></film></sensor><integrator type='volpath'/>";
  const TransportScene absorbing(homogeneous("0.2 0.5 1", "0") + sensor + shell);
  render(absorbing, 512).check(std::exp(-0.4), std::exp(-1), std::exp(-2));
  const TransportScene scattering(homogeneous("0.2 0.5 1", "1") + sensor + shell);
  render(scattering, 1024, {{"rr_depth", "1000000"}}).check(1, 1, 1);
}

TEST_CASE("light samples and scattering find the same light behind null surfaces and masks") {
  // A lamp behind panes, seen through scattering alone.
  const std::string panes =
      "<shape type='rectangle'><transform name='to_world'><scale value='9'/><translate "
      "z='-1'/></transform><bsdf type='mask'><float name='opacity' value='0.4'/><bsdf "
      "type='diffuse'><rgb name='reflectance' value='0'/></bsdf></bsdf></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='9'/><translate "
      "z='-1.5'/></transform><bsdf type='thindielectric'/></shape>";
  const std::string lamp =
      "<shape type='rectangle'><transform name='to_world'><scale value='2'/><translate x='3' "
      "z='-3'/></transform><emitter type='area'><rgb name='radiance' value='8'/></emitter></shape>";
  const std::string cloud =
      homogeneous("1 2 3", "0.9") + "<shape type='sphere'>" + kNull + "</shape>";
  // A light sample is worth nothing to a lamp whose share of the choice is almost zero.
  const std::string rarely = [&] {
    std::string text = lamp;
    text.insert(text.find("<rgb name='radiance'"), "<float name='sampling_weight' value='1e-6'/>");
    return text;
  }();
  const std::string other =
      "<emitter type='point'><point name='position' value='90, 0, 0'/><rgb name='intensity' "
      "value='1e-9'/></emitter>";
  const TransportScene usual(view(12) + cloud + panes + lamp);
  const TransportScene by_scattering(view(12) + cloud + panes + rarely + other);
  const TransportScene::Parameters depth{{"max_depth", "3"}};
  const Mean a = render(usual, 1024, depth), b = render(by_scattering, 4096, depth);
  for (int c = 0; c < 3; ++c) {
    const double error = std::hypot(a.channel[c].error(), b.channel[c].error());
    // The pixels differ, so their spread is no error; it only has to be the same picture.
    CHECK(a.channel[c].mean() == doctest::Approx(b.channel[c].mean()).epsilon(0.02));
    CHECK(error > 0);
  }
}

TEST_CASE("hidden lights stay hidden behind surfaces that light passes straight") {
  const std::string lamp =
      "<shape type='rectangle'><transform name='to_world'><scale value='9'/><rotate y='1' "
      "angle='180'/></transform><emitter type='area'/></shape>";
  const std::string pane =
      "<shape type='rectangle'><transform name='to_world'><scale value='9'/><translate "
      "z='-1'/></transform><bsdf type='null'/></shape>";
  const TransportScene::Parameters hidden{{"hide_emitters", "true"}};
  for (const std::string& light : {lamp, kWhiteSky}) {
    const TransportScene scene(view(2) + pane + light);
    render(scene, 4).check(1, 1, 1);
    render(scene, 4, hidden).check(0, 0, 0);
  }
  // Those methods that do not look for media see such a surface, but not the sky behind it.
  const TransportScene scene(view(2) + pane + kWhiteSky);
  for (const char* method : {"path", "bdpt", "vcm"}) {
    CAPTURE(std::string(method));
    render(scene, 4, {}, method).check(1, 1, 1);
    render(scene, 4, hidden, method).check(0, 0, 0);
  }
}

TEST_CASE("volpath without media has the means of path") {
  const TransportScene scene(
      camera_xml("0, -3, 1", "0, 0, 1", 16) + room_xml(grey("0.6")) + lamp_xml("0.4", "5") +
      "<emitter type='constant'><rgb name='radiance' value='0.3'/></emitter>" +
      sphere_xml("-0.4, 0, 0.6", "0.4", "<bsdf type='dielectric'/>") +
      sphere_xml("0.5, 0, 0.5", "0.35", "<bsdf type='mask'><bsdf type='plastic'/></bsdf>"));
  // No limit of depth: what passes a mask counts as a segment of `path` only, as in Mitsuba.
  TileBatches path, volpath;
  for (uint64_t seed = 0; seed < 64; ++seed) {
    path.add(scene.render("path", {}, 64, seed).image);
    volpath.add(scene.render("volpath", {}, 64, 1000 + seed).image);
  }
  const TileComparison difference = compare_tiles(path, volpath);
  INFO("mean " << difference.ratio << " ± " << difference.ratio_error << ", tiles within "
               << difference.visible_bias);
  CHECK(difference.equal());
  CHECK(difference.ratio_error < 0.0015);
  CHECK(difference.visible_bias < 0.06);
}

TEST_CASE("methods that cannot render media say so, and path does as in Mitsuba") {
  ReadResult read = read_text("<scene version='3.0.0'>" + view(4) + homogeneous("1", "0") + kSlab +
                              kWhiteSky + "</scene>");
  REQUIRE(read.scene);
  SceneDescription& d = read.scene->description;
  const auto message = [&](const std::string& name, const std::string& weights = "") {
    IntegratorOverride with{name, {}, {}};
    if (!weights.empty()) with.parameters.emplace_back("weights", weights);
    apply_override(d.integrator, with);
    Diagnostics diagnostics;
    check_support(d, d.integrator, diagnostics);
    return diagnostics.error_count() == 0 ? "" : diagnostics.all()[0].to_string();
  };
  for (const char* name : {"bdpt", "reuse", "ptracer", "vcm", "path", "volpath"})
    CHECK(message(name) == "");
  for (const std::string& m : {message("ppm"), message("bpm"), message("reuse", "thesis")}) {
    CAPTURE(m);
    CHECK(m.find("scene.xml:1:") != m.npos);
    CHECK(m.find("cannot render this scene: ") != m.npos);
    CHECK(m.find("participating media") != m.npos);
  }
  d.shapes.clear();
  apply_override(d.integrator, {"bpm", {}, {}});
  Diagnostics none;
  check_support(d, d.integrator, none);
  CHECK(none.error_count() == 0);

  const TransportScene scene(view(4) + homogeneous("1", "0") + kSlab + kWhiteSky);
  // Surfaces without BSDF are passed, and the medium is not seen.
  render(scene, 16, {}, "path").check(1, 1, 1);
}
