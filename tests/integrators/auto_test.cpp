// Which method is chosen for which scene, and that the choice depends on nothing else.
#include "integrators/auto.h"

#include <chrono>
#include <cmath>

#include "integrators/method_choice.h"
#include "integrators/method_rules.h"
#include "support/show.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kCamera = camera_xml("0, -3, 1", "0, 0, 1", 32);
const std::string kPoint =
    "<emitter type='point'><point name='position' value='0, 0, 1.9'/>"
    "<rgb name='intensity' value='1'/></emitter>";
const std::string kGlassBall = sphere_xml("-0.4, 0, 0.6", "0.4", "<bsdf type='dielectric'/>");
const std::string kWalls = room_xml(grey("0.7, 0.7, 0.7"));

struct Chosen {
  std::string name;
  double light_paths = 0;
  std::string reason, bias;
};

Chosen choose(const TransportScene& s, int max_depth = 8, int threads = 2, int spp = 256) {
  AutoIntegratorDescription options;
  options.max_depth = max_depth;
  const MethodChoice c = choose_method(*s.scene, options, {s.layout.full, spp, threads});
  IntegratorDescription d;
  d.method = c.method;
  Chosen choice{integrator_name(d), 0, c.reason, c.bias};
  // The help names every method that there is to choose from.
  REQUIRE(integrator_names()[0].name == "auto");
  CHECK((" " + integrator_names()[0].summary).find(" " + choice.name) != std::string::npos);
  if (const auto* b = std::get_if<BidirectionalIntegratorDescription>(&c.method)) {
    choice.light_paths = b->light_paths;
    CHECK(b->max_depth == max_depth);
  }
  return choice;
}

bool merges(const Chosen& c) {
  return c.name == "vcm" || c.name == "ppm";
}

}  // namespace

TEST_CASE("rules from what a scene contains") {
  SceneFeatures f;
  CHECK(!method_rules(f).has_lights);
  CHECK(describe(method_rules(f)) == "no lights");
  f.area_lights = 1;
  CHECK(method_rules(f) == MethodRules{});
  f.rough_reflection = 1;
  CHECK(method_rules(f) == MethodRules{.may_merge = true});
  f.mirrors = 1;
  CHECK(method_rules(f) == MethodRules{.may_merge = true});
  f.spot_lights = 1;
  CHECK(method_rules(f) == MethodRules{.needs_light_subpaths = true, .may_merge = true});
  SceneFeatures sky;
  sky.environment_map = true;
  CHECK(method_rules(sky) == MethodRules{.far_lights_only = true});
  sky.masks = 1;
  CHECK(method_rules(sky) == MethodRules{.may_merge = true, .far_lights_only = true});
  sky.directional_lights = 1;
  CHECK(method_rules(sky).needs_light_subpaths);
  SceneFeatures fog = f;
  fog.media = 1;
  CHECK(method_rules(fog) == MethodRules{.needs_light_subpaths = true,
                                         .may_merge = true,
                                         .skips_passed_surfaces = true,
                                         .has_media = true});
  fog.heterogeneous_media = 1;
  CHECK(method_rules(fog).has_heterogeneous_media);
  // Masks stop light samples no longer.
  SceneFeatures pbrt = sky;
  pbrt.skips_masks = true;
  CHECK(!method_rules(pbrt).needs_light_subpaths);
  sky.media = 1;
  CHECK(!method_rules(sky).needs_light_subpaths);
  for (const SceneFeatures& any : {f, sky, fog}) CHECK(!describe(method_rules(any)).empty());
}

namespace {

/// A room full of fog.
const std::string kFog =
    "<medium type='homogeneous' id='fog'><float name='sigma_t' value='0.2'/></medium>"
    "<shape type='cube'><transform name='to_world'><scale value='4'/></transform>"
    "<bsdf type='null'/><ref id='fog' name='interior'/></shape>";

}  // namespace

TEST_CASE("a cloud in the open is left to path tracing, and a lamp behind a screen in fog is not") {
  const std::string cloud =
      sphere_xml("0, 0, 0.7", "0.65",
                 "<bsdf type='null'/><medium type='homogeneous' name='interior'>"
                 "<float name='sigma_t' value='5'/><float name='albedo' value='0.9'/></medium>");
  const std::string ground =
      "<shape type='rectangle'><transform name='to_world'><scale value='6'/></transform>" +
      grey("0.5, 0.5, 0.5") + "</shape>";
  const std::string point =
      "<emitter type='point'><point name='position' value='2, -2, 4'/>"
      "<rgb name='intensity' value='40'/></emitter>";
  const Chosen open = choose(TransportScene(kCamera + ground + cloud + point));
  CAPTURE(open.reason);
  CHECK(open.name == "volpath");
  CHECK(open.bias.empty());
  const std::string screen =
      "<shape type='rectangle'><transform name='to_world'><scale value='0.9'/>"
      "<translate z='1.7'/></transform>" +
      grey("0.5, 0.5, 0.5") + "</shape>";
  const Chosen hidden =
      choose(TransportScene(kCamera + kWalls + kFog + screen + lamp_xml("0.1", "100")));
  CAPTURE(hidden.reason);
  CHECK(hidden.name == "bdpt");
  CHECK(hidden.bias.empty());
}

TEST_CASE("light sub-paths are taken where path tracing through media loses light") {
  const Chosen c = choose(TransportScene(kCamera + kWalls + kFog + kPoint + kGlassBall));
  CAPTURE(c.reason);
  CHECK(c.reason.find("volpath would miss") != std::string::npos);
  CHECK(c.light_paths > 0);
}

TEST_CASE("without specular surfaces nothing is merged") {
  const Chosen c = choose(TransportScene(kCamera + kWalls + lamp_xml("0.5", "5")));
  CAPTURE(c.reason);
  CHECK(!merges(c));
  CHECK(c.bias.empty());
}

TEST_CASE("under an open sky paths start at the camera") {
  const Chosen c =
      choose(TransportScene(kCamera + sphere_xml("0, 0, 1", "0.5", grey("0.5, 0.5, 0.5")) +
                            "<emitter type='constant'><rgb name='radiance' value='1'/></emitter>"));
  CAPTURE(c.reason);
  CHECK(c.name == "path");
}

TEST_CASE("nothing is tried where there is nothing to choose") {
  CHECK(choose(TransportScene(kCamera + kWalls)).reason == "path: the scene has no lights");
  CHECK(choose(TransportScene(kCamera + kWalls + kFog)).reason ==
        "volpath: the scene has no lights");
  const TransportScene lit(kCamera + kWalls + kPoint);
  CHECK(choose(lit, 1).reason == "path: paths of one segment are seen directly");
}

// Rays from the sky enter where the camera looks, however large the ground is. Those of a sun that
// path tracing meets by chance alone make light that its image has in few pixels.
TEST_CASE("light from far away is followed where path tracing would have it in few pixels") {
  const std::string ground =
      "<shape type='rectangle'><transform name='to_world'><scale value='10000'/></transform>" +
      grey("0.5, 0.5, 0.5") + "</shape>";
  CHECK(choose(TransportScene(camera_xml("0, -3, 3", "0, 0, 0.3", 32) + ground +
                              sphere_xml("0, 0, 0.5", "0.5", grey("0.5, 0.5, 0.5")) +
                              "<emitter type='constant'/>"))
            .name == "path");
  const Chosen c = choose(TransportScene(
      camera_xml("0, -2, 0.6", "0, 0, 0", 32) + ground +
      "<shape type='cube'><transform name='to_world'><scale x='4' y='4' z='0.05'/><translate "
      "z='1.5'/></transform><bsdf type='dielectric'/></shape>"
      "<emitter type='sunsky'><transform name='to_world'><rotate x='1' angle='90'/></transform>"
      "<vector name='sun_direction' x='1' y='-0.3' z='1'/></emitter>"));
  CAPTURE(c.reason);
  CHECK(c.name != "path");
  CHECK(c.reason.find("of the light in fewer than 0.1 % of the pixels") != std::string::npos);
}

TEST_CASE("light sub-paths are taken where path tracing loses light") {
  const Chosen c = choose(TransportScene(kCamera + kWalls + kPoint + kGlassBall));
  CAPTURE(c.reason);
  CHECK(c.name != "path");
  CHECK(c.light_paths > 0);
}

TEST_CASE("light that only merging finds is not lost") {
  const Chosen c = choose(
      TransportScene(camera_xml("0, -0.9, 1", "0, 1, 0.9", 32) +
                     room_xml("<bsdf type='twosided'><bsdf type='plastic'/></bsdf>") + kPoint +
                     kGlassBall + sphere_xml("0.5, 0.3, 0.5", "0.45", "<bsdf type='conductor'/>")));
  CAPTURE(c.reason);
  CHECK(merges(c));
  CHECK(c.bias == "some light is found by merging only, or in few pixels: consistent, but biased");
  CHECK(c.reason.find("; consistent, biased") != std::string::npos);
}

TEST_CASE("caustics in mirrors are merged") {
  const Chosen c = choose(TransportScene("thesis-modified", 64));
  CAPTURE(c.reason);
  CHECK(merges(c));
  CHECK(!c.bias.empty());
}

// Nothing is merged on the bulb itself.
TEST_CASE("a nearly specular bulb does not keep light from being merged elsewhere") {
  const auto bulb = [](const std::string& glass) {
    return TransportScene(kCamera + kWalls +
                          sphere_xml("0, 0, 1.3", "0.03",
                                     "<emitter type='area'><rgb name='radiance' value='900'/>"
                                     "</emitter>") +
                          sphere_xml("0, 0, 1.3", "0.2", glass));
  };
  const Chosen rough =
      choose(bulb("<bsdf type='roughdielectric'><float name='alpha' value='0.005'/></bsdf>"));
  CAPTURE(rough.reason);
  CHECK(merges(rough));
  const Chosen smooth = choose(bulb("<bsdf type='dielectric'/>"));
  CAPTURE(smooth.reason);
  CHECK(merges(smooth));
}

// Path tracing and connections meet the narrow lobes by chance only; photons on the body do not.
TEST_CASE("photons are merged on a body in rough glass") {
  for (const std::string alpha : {"0.03", "0.1"}) {
    const TransportScene s(
        camera_xml("0, -4, 2", "0, 0, 0.6", 64) +
        "<shape type='rectangle'><transform name='to_world'><scale value='5'/></transform>" +
        grey("0.5, 0.5, 0.5") + "</shape>" +
        "<shape type='cube'><transform name='to_world'><scale value='0.7'/>"
        "<translate z='0.72'/></transform><bsdf type='roughdielectric'><float name='alpha' "
        "value='" +
        alpha + "'/></bsdf></shape>" + sphere_xml("0, 0, 0.7", "0.35", grey("0.8, 0.4, 0.2")) +
        "<emitter type='directional'><vector name='direction' x='0.4' y='0.3' z='-1'/></emitter>");
    for (const int spp : {64, 256}) {
      const Chosen c = choose(s, 12, 2, spp);
      CAPTURE(alpha);
      CAPTURE(c.reason);
      CHECK(merges(c));
    }
  }
}

TEST_CASE("methods that merge have to promise 1.3 times as much, and no rule overrules more") {
  const auto taken = [](double path, double bdpt, double vcm) {
    MethodPrices prices;
    const std::pair<const char*, double> methods[] = {{"path", path}, {"bdpt", bdpt}, {"vcm", vcm}};
    for (const auto& [name, error] : methods) {
      MethodCandidate c;
      c.name = name;
      c.light_paths = prices.candidates.empty() ? 0 : 1;
      c.merges = c.name == "vcm" ? 0.5 : 0;
      prices.candidates.push_back(c);
      PredictedMethod p;
      p.variance = p.error = error, p.cost = 1;
      prices.predictions.push_back(p);
    }
    const std::string reason = take(prices, {.may_merge = true}).reason;
    return reason.substr(0, reason.find(':'));
  };
  CHECK(taken(1, 2, 3) == "path");
  CHECK(taken(1.15, 1, 0.9) == "path");
  CHECK(taken(1.25, 1, 0.8) == "bdpt");
  CHECK(taken(1.25, 1, 0.7) == "vcm");
  CHECK(taken(1, 1, 0.01) == "vcm");
}

TEST_CASE("the number of samples decides whether blur is worth it") {
  const TransportScene s("thesis-modified", 64);
  const auto chosen = [&](const RenderOutlook& outlook) {
    AutoIntegratorDescription options;
    options.max_depth = 8;
    const MethodChoice c = choose_method(*s.scene, options, outlook);
    CAPTURE(c.reason);
    return !c.bias.empty();
  };
  const Point2i film = s.layout.full;
  CHECK(chosen({film, 64, 2}));
  CHECK(!chosen({film, 1000000, 2}));
  CHECK(chosen({film, 0, 2, 10.0}));
  CHECK(!chosen({film, 0, 2, 1e7}));
  CHECK(chosen({film, 0, 2, {}, 0.05}));
  CHECK(!chosen({film, 0, 2, {}, 1e-4}));
}

TEST_CASE("photons alone are enough where much light is merged anyway") {
  const auto with_64_samples = [](const std::string& scene) {
    return choose(TransportScene(scene, 128), 8, 2, 64);
  };
  const Chosen lamp = with_64_samples("lamp-in-glass");
  CAPTURE(lamp.reason);
  CHECK(lamp.name == "ppm");
  CHECK(!lamp.bias.empty());
}

TEST_CASE("the choice does not depend on threads where there are media") {
  const TransportScene s(kCamera + kWalls + kFog + lamp_xml("0.3", "10"));
  const Chosen one = choose(s, 8, 1);
  for (const int threads : {2, 7}) CHECK(choose(s, 8, threads).reason == one.reason);
}

TEST_CASE("the choice does not depend on threads or windows") {
  const TransportScene s("thesis-modified", 48);
  const Chosen one = choose(s, 8, 1);
  for (const int threads : {2, 7}) CHECK(choose(s, 8, threads).reason == one.reason);
  // A film that shows a part is decided on like the whole.
  FilmLayout window = s.layout;
  window.crop = {10, 20, 26, 36};
  const auto full = s.method("auto", {}), part = s.method("auto", {});
  const RenderResult all = s.render(*full, s.layout, 2, 3), some = s.render(*part, window, 2, 3, 5);
  REQUIRE(full->decision());
  REQUIRE(part->decision());
  CHECK(part->decision()->reason == full->decision()->reason);
  const size_t channels = all.image.channels.size();
  int differ = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (size_t c = 0; c < channels; ++c)
        differ += some.image.data[(size_t(y) * 16 + size_t(x)) * channels + c] !=
                  all.image.data[(size_t(y + 20) * 48 + size_t(x + 10)) * channels + c];
  CHECK(differ == 0);
}

TEST_CASE("parameters of other methods are kept, and those it has not are refused") {
  IntegratorDescription d;
  d.method = PathIntegratorDescription{{7, 3, true, true}};
  apply_override(d, {"auto", {}, {}});
  CHECK(integrator_parameters(d) ==
        "max_depth=7 rr_depth=3 hide_emitters=true strict_normals=true light_selection=auto");
  CHECK_THROWS_AS(apply_override(d, {"", {{"light_paths", "1"}}, {}}), std::invalid_argument);
  CHECK_THROWS_AS(make_integrator(d, TechniqueOutput::weighted), std::invalid_argument);
  const auto undecided = make_integrator(d);
  CHECK(!undecided->decision());
  Film film({{4, 4}, {0, 0, 4, 4}, {}}, undecided->channels());
  CHECK_THROWS_AS(undecided->prepare(film), std::logic_error);
}

TEST_CASE("the choice counts towards the time, and there is an image even so") {
  const TransportScene s(camera_xml("0, -3, 1", "0, 0, 1", 12) + kWalls + kPoint + kGlassBall);
  RenderRequest request;
  request.budget.seconds = 1e-3;
  const auto method = s.method("auto", {{"max_depth", "5"}});
  const auto start = std::chrono::steady_clock::now();
  const RenderResult result = render(*s.scene, *method, s.layout, request);
  const double all =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CHECK(result.spp == 1);
  CHECK(result.seconds > 0.9 * all);
}

// A pilot that decides on what it sees, and whose samples are in the image, would be wrong here.
TEST_CASE("256 short renders have the mean of a long one") {
  const TransportScene s(camera_xml("0, -3, 1", "0, 0, 1", 12) + kWalls + kPoint +
                         sphere_xml("0.5, 0, 0.4", "0.3", grey("0.5, 0.5, 0.5")));
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (size_t i = 0; i < image.data.size(); i += 4) sum += double(image.data[i]);
    return sum / double(image.data.size() / 4);
  };
  const double expected = mean(s.render("path", {{"max_depth", "5"}}, 8192, 99).image);
  double sum = 0, squares = 0;
  constexpr int kRenders = 256;
  for (int i = 0; i < kRenders; ++i) {
    const auto method = s.method("auto", {{"max_depth", "5"}});
    const double m = mean(s.render(*method, s.layout, 1, uint64_t(i)).image);
    CHECK(method->bias().empty());
    sum += m, squares += m * m;
  }
  const double average = sum / kRenders;
  const double error = std::sqrt((squares / kRenders - average * average) / kRenders + 1e-12);
  CHECK(std::abs(average - expected) < 3.5 * error);
  CHECK(error < 0.01 * expected);
}

TEST_CASE("auto: a decision that was made before is the method, and is not made again") {
  const TransportScene s(kCamera + kWalls + kPoint + kGlassBall);
  IntegratorDescription description = s.integrator;
  description.method = AutoIntegratorDescription{};
  const std::vector<std::pair<std::string, TransportScene::Parameters>> methods = {
      {"path", {{"max_depth", "7"}}},
      {"bdpt", {{"max_depth", "6"}, {"light_paths", "0.37"}, {"connections", "2"}}},
      {"vcm", {{"max_depth", "5"}, {"radius", "0.012345678901"}}},
      {"ppm", {{"alpha", "0.7"}}},
      {"volpath", {{"rr_depth", "3"}}}};
  for (const auto& [name, parameters] : methods) {
    SHOW(name);
    IntegratorDescription direct = s.integrator;
    apply_override(direct, {name, parameters, {}});
    MethodDecision decision{
        integrator_name(direct), integrator_parameters(direct), "made before", {}};
    if (name == "vcm") {
      decision.merge_parts.assign(256, 0);
      for (size_t i = 0; i < 100; ++i) decision.merge_parts[i] = 1;
      std::get<BidirectionalIntegratorDescription>(direct.method).merge_parts =
          decision.merge_parts;
    }
    AutoIntegrator chooser(AutoIntegratorDescription{}, description);
    chooser.adopt(decision);
    const Image image = s.render(chooser, s.layout, 2, 1).image;
    REQUIRE(chooser.decision());
    CHECK(chooser.decision()->reason == "made before");
    CHECK(s.render(*make_integrator(direct), s.layout, 2, 1).image.data == image.data);
  }
  AutoIntegrator chooser(AutoIntegratorDescription{}, description);
  CHECK_THROWS_AS(chooser.adopt({"none", "", "", {}}), std::invalid_argument);
  CHECK_THROWS_AS(chooser.adopt({"path", "max_depth", "", {}}), std::invalid_argument);
}
