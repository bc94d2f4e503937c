// What -i and -I make of the description of a method.
#include "integrators/make_integrator.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace duet;

namespace {

using Bidirectional = BidirectionalIntegratorDescription;
using Parameters = std::vector<std::pair<std::string, std::string>>;

IntegratorDescription describe(const decltype(IntegratorDescription::method)& method) {
  IntegratorDescription d;
  d.method = method;
  return d;
}

IntegratorDescription with(IntegratorDescription d, const std::string& name,
                           const Parameters& parameters = {}) {
  apply_override(d, {name, parameters, {}});
  return d;
}

/// The message of the refusal; "" if nothing is refused.
std::string refusal(const std::string& name, const Parameters& parameters) {
  try {
    with({}, name, parameters);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

Bidirectional bidirectional(const std::string& name, const Parameters& parameters) {
  return std::get<Bidirectional>(with({}, name, parameters).method);
}

}  // namespace

TEST_CASE("every method can be selected by its name and says it again") {
  std::string all;
  for (const IntegratorName& n : integrator_names()) {
    CAPTURE(n.name);
    CHECK(!n.summary.empty());
    all += n.name + " ";
    CHECK(integrator_name(with({}, n.name)) == n.name);
    CHECK(integrator_name(with(describe(Bidirectional{}), n.name)) == n.name);
  }
  CHECK(all == "auto path volpath volpathmis direct ptracer bdpt reuse ppm bpm vcm depth ao aov ");
  CHECK(refusal("bdtp", {}) ==
        "there is no integrator \"bdtp\" (did you mean \"bdpt\"?); there are auto, path, "
        "volpath, volpathmis, direct, ptracer, bdpt, reuse, ppm, bpm, vcm, depth, ao, aov");
}

TEST_CASE("the parameters of each method, with their presets") {
  const auto parameters = [](const std::string& name) {
    return integrator_parameters(with({}, name));
  };
  const std::string paths = "max_depth=-1 rr_depth=2 hide_emitters=false",
                    own = paths + " strict_normals=false light_selection=auto",
                    lights = " light_paths=0 guide_emission=true", more = own + lights;
  CHECK(parameters("path") == own + " only_specular=false pixel_group=1");
  CHECK(parameters("auto") == own);
  CHECK(parameters("ptracer") == paths + lights);
  CHECK(parameters("bdpt") == more + " connections=-1 light_image=true pixel_group=1");
  CHECK(parameters("reuse") ==
        more + " max_eye_depth=4 max_light_depth=3 weights=exact continue_probability=1");
  CHECK(parameters("ppm") == more + " radius=0 alpha=0");
  CHECK(parameters("bpm") == more + " radius=0 alpha=0");
  CHECK(parameters("vcm") == more + " connections=-1 radius=0 alpha=0");
  CHECK(integrator_parameters(with({}, "reuse", {{"weights", "thesis"}})) ==
        more +
            " max_eye_depth=4 max_light_depth=3 weights=thesis thesis_reading=b "
            "continue_probability=1");
}

TEST_CASE("the parameters of bidirectional methods can be set") {
  const Parameters paths{{"max_depth", "8"}, {"rr_depth", "2"}, {"hide_emitters", "true"}};
  const auto and_more = [&](Parameters more) {
    more.insert(more.end(), paths.begin(), paths.end());
    return more;
  };
  using enum BidirectionalMethod;
  CHECK(bidirectional("ptracer", and_more({{"light_paths", "0.5"}})) ==
        Bidirectional{.method = ptracer,
                      .max_depth = 8,
                      .rr_depth = 2,
                      .hide_emitters = true,
                      .light_paths = 0.5});
  CHECK(bidirectional("bdpt", {{"strict_normals", "1"},
                               {"light_paths", "2"},
                               {"connections", "4"},
                               {"light_image", "0"}}) == Bidirectional{.method = bdpt,
                                                                       .strict_normals = true,
                                                                       .light_paths = 2,
                                                                       .connections = 4,
                                                                       .light_image = false});
  for (const auto& [name, method] : {std::pair{"ppm", ppm}, {"bpm", bpm}, {"vcm", vcm}})
    CHECK(bidirectional(name, {{"radius", "1e-2"}, {"alpha", "0.7"}}) ==
          Bidirectional{.method = method, .radius = 0.01, .alpha = 0.7});
  CHECK(bidirectional("vcm", {{"connections", "0"}}).connections == 0);
  CHECK(
      bidirectional(
          "reuse",
          {{"max_eye_depth", "0"}, {"max_light_depth", "5"}, {"continue_probability", "0.25"}}) ==
      Bidirectional{
          .method = reuse, .max_eye_depth = 0, .max_light_depth = 5, .continue_probability = 0.25});
}

TEST_CASE("the reading of the thesis may be given before its weights and survives them") {
  using enum ReuseWeights;
  CHECK(bidirectional("reuse", {{"thesis_reading", "a"}, {"weights", "thesis"}}).weights ==
        thesis_a);
  CHECK(bidirectional("reuse", {{"weights", "thesis"}, {"thesis_reading", "b"}}).weights ==
        thesis_b);
  CHECK(bidirectional("reuse", {{"weights", "thesis"}}).weights == thesis_b);
  const auto scene =
      describe(Bidirectional{.method = BidirectionalMethod::reuse, .weights = thesis_a});
  CHECK(with(scene, "", {{"weights", "thesis"}}).method == scene.method);
  CHECK(std::get<Bidirectional>(with(scene, "", {{"weights", "exact"}}).method).weights == exact);
}

TEST_CASE("values that a parameter cannot have are refused by name") {
  const std::tuple<const char*, const char*, const char*, const char*> cases[] = {
      {"bdpt", "light_paths", "1e9", "a number from 0 to 65536"},
      {"bdpt", "light_paths", "nan", "a number from 0 to 65536"},
      {"bdpt", "light_paths", "1x", "a number from 0 to 65536"},
      {"bdpt", "light_paths", "", "a number from 0 to 65536"},
      {"bdpt", "connections", "-2", "a whole number from -1 to 65536"},
      {"vcm", "connections", "65537", "a whole number from -1 to 65536"},
      {"bdpt", "light_image", "maybe", "true or false"},
      {"ppm", "radius", "-1", "a number from 0 to 3.4"},
      {"ppm", "radius", "inf", "a number from 0 to 3.4"},
      {"vcm", "alpha", "1.01", "a number from 0 to 1"},
      {"vcm", "alpha", "-0.5", "a number from 0 to 1"},
      {"reuse", "max_eye_depth", "-1", "a whole number from 0 to 65536"},
      {"reuse", "max_light_depth", "65537", "a whole number from 0 to 65536"},
      {"reuse", "continue_probability", "0", "a number above 0, up to 1"},
      {"reuse", "continue_probability", "1.5", "a number above 0, up to 1"},
      {"reuse", "weights", "b", "exact or thesis"},
      {"reuse", "thesis_reading", "c", "a or b"},
      {"reuse", "thesis_reading", "a", "weights=thesis"},
      {"path", "light_selection", "tree", "auto, bvh, power or uniform"},
  };
  for (const auto& [method, name, value, needs] : cases) {
    const std::string message = refusal(method, {{name, value}});
    CAPTURE(message);
    CHECK(message.starts_with(fmt::format("parameter \"{}\" needs {}", name, needs)));
  }
  CHECK(refusal("bdpt", {{"radius", "1"}}) == "integrator \"bdpt\" has no parameter \"radius\"");
  CHECK(refusal("vcm", {{"conections", "1"}}) ==
        "integrator \"vcm\" has no parameter \"conections\" (did you mean \"connections\"?)");
  CHECK(refusal("ptracer", {{"strict_normals", "true"}}).starts_with("integrator \"ptracer\" has"));
  CHECK(refusal("ptracer", {{"light_selection", "bvh"}}).starts_with("integrator \"ptracer\" has"));
}

TEST_CASE("another method keeps what the scene said about paths and nothing else") {
  const PathIntegratorDescription path{{8, 3, true, true, LightSelection::bvh}};
  for (const std::string name : {"bdpt", "reuse", "ppm", "bpm", "vcm"}) {
    CAPTURE(name);
    const IntegratorDescription selected = with(describe(path), name);
    const auto& d = std::get<Bidirectional>(selected.method);
    CHECK(d == Bidirectional{.method = d.method,
                             .max_depth = 8,
                             .rr_depth = 3,
                             .hide_emitters = true,
                             .strict_normals = true,
                             .light_selection = LightSelection::bvh});
    CHECK(light_selection(selected) == LightSelection::bvh);
    CHECK(with(selected, "path") == describe(path));
  }
  CHECK(with(describe(path), "ptracer").method ==
        describe(Bidirectional{.method = BidirectionalMethod::ptracer,
                               .max_depth = 8,
                               .rr_depth = 3,
                               .hide_emitters = true})
            .method);
  const auto vcm = describe(Bidirectional{.method = BidirectionalMethod::vcm,
                                          .max_depth = 8,
                                          .light_paths = 2,
                                          .connections = 3,
                                          .radius = 1,
                                          .alpha = 0.5});
  CHECK(with(vcm, "bdpt") == describe(Bidirectional{.max_depth = 8}));
  CHECK(with(vcm, "vcm") == vcm);
  CHECK(with(vcm, "") == vcm);
  CHECK(with(vcm, "depth") == describe(DepthIntegratorDescription{}));
  CHECK(with(describe(DirectIntegratorDescription{4, 4, true, true}), "bdpt") ==
        describe(Bidirectional{.hide_emitters = true, .strict_normals = true}));
  CHECK(with(describe(Bidirectional{.hide_emitters = true}), "direct") ==
        describe(DirectIntegratorDescription{1, 1, true, false}));
}

TEST_CASE("layers stay with another method, and layers alone come from camera rays") {
  IntegratorDescription scene = describe(Bidirectional{.max_depth = 4});
  scene.aovs.layers = {{"albedo", "a"}};
  scene.moments = true;
  const IntegratorDescription vcm = with(scene, "vcm"), aov = with(scene, "aov");
  CHECK(vcm.aovs == scene.aovs);
  CHECK(vcm.moments);
  CHECK(vcm.image);
  CHECK(!aov.image);
  CHECK(aov.method == describe(PathIntegratorDescription{{.max_depth = 4}}).method);
  CHECK(with(aov, "bdpt").image);
}
