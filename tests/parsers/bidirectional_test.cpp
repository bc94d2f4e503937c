// What the parameters of the methods that trace light sub-paths become. Values that Mitsuba sets
// itself are those of 0.6.
#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "parsers/plugin_checks.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

using Bidirectional = BidirectionalIntegratorDescription;
using enum BidirectionalMethod;

constexpr const char* kVersions[] = {"0.6.0", "3.0.0"};

ReadResult read_integrator(const std::string& version, const std::string& element) {
  return read_text("<scene version='" + version + "'>\n<sensor type='perspective'/>\n" + element +
                   "<emitter type='constant'/></scene>");
}

Bidirectional method(const std::string& version, const std::string& type,
                     const std::string& content = "") {
  return std::get<Bidirectional>(
      integrator(version, "<integrator type='" + type + "'>" + content + "</integrator>").method);
}

/// All methods share these.
const std::string kPaths =
    "<integer name='max_depth' value='7'/><integer name='rr_depth' value='9'/>"
    "<boolean name='hide_emitters' value='true'/>";
const std::string kPathsAndMore = kPaths +
                                  "<boolean name='strict_normals' value='true'/>"
                                  "<float name='light_paths' value='0.25'/>";
const std::string kMerging =
    "<float name='radius' value='0.125'/><float name='alpha' value='0.75'/>";

}  // namespace

TEST_CASE("bidirectional integrators without parameters have the presets of the description") {
  const std::pair<std::string, BidirectionalMethod> names[] = {
      {"ptracer", ptracer}, {"bdpt", bdpt}, {"reuse", reuse}, {"bpm", bpm}, {"vcm", vcm}};
  for (const auto& [name, kind] : names)
    for (const std::string version : kVersions) {
      SHOW(name);
      CAPTURE(version);
      const ReadResult r = read_integrator(version, "<integrator type='" + name + "'/>");
      REQUIRE(r.scene);
      CHECK(r.messages() == "");
      CHECK(r.description().approximations.empty());
      CHECK(std::get<Bidirectional>(r.description().integrator.method) ==
            Bidirectional{.method = kind});
    }
  CHECK(method("3.0.0", "ppm") == Bidirectional{.method = ppm});
}

TEST_CASE("bidirectional integrators take all of their parameters in files of every version") {
  for (const std::string version : kVersions) {
    CAPTURE(version);
    CHECK(method(version, "ptracer", kPaths + "<float name='light_paths' value='0.25'/>") ==
          Bidirectional{.method = ptracer,
                        .max_depth = 7,
                        .rr_depth = 9,
                        .hide_emitters = true,
                        .light_paths = 0.25});
    Bidirectional expected{.method = bdpt,
                           .max_depth = 7,
                           .rr_depth = 9,
                           .hide_emitters = true,
                           .strict_normals = true,
                           .light_paths = 0.25,
                           .connections = 3,
                           .light_image = false};
    CHECK(method(version, "bdpt",
                 kPathsAndMore +
                     "<integer name='connections' value='3'/><boolean name='light_image' "
                     "value='false'/>") == expected);
    expected = {.method = vcm,
                .max_depth = 7,
                .rr_depth = 9,
                .hide_emitters = true,
                .strict_normals = true,
                .light_paths = 0.25,
                .connections = 3,
                .radius = 0.125,
                .alpha = 0.75};
    CHECK(method(version, "vcm",
                 kPathsAndMore + kMerging + "<integer name='connections' value='3'/>") == expected);
    expected.connections = -1;
    for (const auto& [name, kind] : {std::pair{"ppm", ppm}, std::pair{"bpm", bpm}}) {
      expected.method = kind;
      CHECK(method(version, name, kPathsAndMore + kMerging) == expected);
    }
    expected = {.method = reuse,
                .max_depth = 7,
                .rr_depth = 9,
                .hide_emitters = true,
                .strict_normals = true,
                .light_paths = 0.25,
                .max_eye_depth = 2,
                .max_light_depth = 0,
                .weights = ReuseWeights::thesis_a,
                .continue_probability = 0.5};
    CHECK(method(version, "reuse",
                 kPathsAndMore +
                     "<integer name='max_eye_depth' value='2'/><integer name='max_light_depth' "
                     "value='0'/><string name='weights' value='thesis'/><string "
                     "name='thesis_reading' value='a'/><float name='continue_probability' "
                     "value='0.5'/>") == expected);
  }
}

TEST_CASE("bidirectional integrators: the old spelling, and initial_radius for radius") {
  CHECK(method("0.6.0", "bdpt",
               "<boolean name='lightImage' value='false'/><boolean name='sampleDirect' "
               "value='false'/><integer name='maxDepth' value='3'/><integer name='rrDepth' "
               "value='4'/>") ==
        Bidirectional{.method = bdpt, .max_depth = 3, .rr_depth = 4, .light_image = false});
  for (const char* name : {"ppm", "bpm", "vcm", "sppm"})
    for (const char* parameter : {"initialRadius", "initial_radius", "radius"})
      CHECK(method("0.6.0", name, fmt::format("<float name='{}' value='2'/>", parameter)).radius ==
            2);
  CHECK(read_integrator("0.6.0",
                        "<integrator type='bpm'><float name='radius' value='1'/><float "
                        "name='initialRadius' value='1'/></integrator>")
            .has("given twice"));
}

TEST_CASE("the weights of reuse: exact, or those of the thesis in one of two readings") {
  const auto weights = [](const std::string& content) {
    return method("3.0.0", "reuse", content).weights;
  };
  CHECK(weights("<string name='weights' value='exact'/>") == ReuseWeights::exact);
  CHECK(weights("<string name='weights' value='thesis'/>") == ReuseWeights::thesis_b);
  CHECK(weights("<string name='weights' value='Thesis'/><string name='thesis_reading' "
                "value='b'/>") == ReuseWeights::thesis_b);
  // The reading may come first.
  CHECK(weights("<string name='thesis_reading' value='a'/><string name='weights' "
                "value='thesis'/>") == ReuseWeights::thesis_a);
}

TEST_CASE("photon mapping of 0.6 is approximated by ppm, with a warning") {
  for (const std::string name : {"ppm", "sppm", "photonmapper"}) {
    CAPTURE(name);
    const std::string element = fmt::format("<integrator type='{}'/>", name);
    const std::string what =
        fmt::format("the integrator \"{}\" of Mitsuba 0.6 is approximated by Duet's \"ppm\"", name);
    const ReadResult r = read_integrator("0.6.0", element);
    REQUIRE(r.scene);
    CHECK(r.messages() == "/scene/scene.xml:3:1: warning: " + what + "\n");
    REQUIRE(r.description().approximations.size() == 1);
    CHECK(r.description().approximations[0].message == what);
    // Duet has a "ppm" of its own, which files of version 3 mean.
    CHECK(read_integrator("3.0.0", element).has(what) == (name != "ppm"));
  }
  CHECK(method("0.6.0", "ppm") == Bidirectional{.method = ppm, .rr_depth = 3, .alpha = 0.7});
  CHECK(method("0.6.0", "sppm") == Bidirectional{.method = ppm, .rr_depth = 3, .alpha = 0.7});
  CHECK(method("0.6.0", "photonmapper") == Bidirectional{.method = ppm});
  CHECK(method("0.6.0", "sppm",
               "<integer name='maxDepth' value='4'/><integer name='rrDepth' value='6'/>"
               "<float name='alpha' value='0.5'/><float name='initialRadius' value='0.25'/>") ==
        Bidirectional{.method = ppm, .max_depth = 4, .rr_depth = 6, .radius = 0.25, .alpha = 0.5});
  CHECK(method("0.6.0", "photonmapper", kPaths) ==
        Bidirectional{.method = ppm, .max_depth = 7, .rr_depth = 9, .hide_emitters = true});
}

TEST_CASE("parameters that change nothing in Duet are accepted without a word") {
  const auto remarks = [](const std::string& type, const std::string& content) {
    const ReadResult r =
        read_integrator("0.6.0", "<integrator type='" + type + "'>" + content + "</integrator>");
    REQUIRE(r.scene);
    return r.diagnostics.all().size();
  };
  const auto number = [](const std::string& name) {
    return "<integer name='" + name + "' value='100'/>";
  };
  CHECK(remarks("ptracer", number("granularity") + number("samplesPerPass") +
                               "<boolean name='bruteForce' value='false'/>") == 0);
  // Each has the one warning about the method.
  for (const char* type : {"ppm", "sppm"})
    CHECK(remarks(type, number("photonCount") + number("maxPasses") + number("granularity")) == 1);
  CHECK(remarks("photonmapper",
                number("directSamples") + number("glossySamples") + number("globalPhotons") +
                    number("causticPhotons") + number("volumePhotons") + number("lookupSize") +
                    number("granularity") + "<float name='globalLookupRadius' value='0.1'/>" +
                    "<float name='causticLookupRadius' value='0.1'/>") == 1);
}

TEST_CASE("bidirectional integrators: values that make no sense are errors with their place") {
  struct Case {
    const char *type, *value, *message;
  };
  const Case cases[] = {
      {"bdpt", "<float name='light_paths' value='-1'/>", "must be at least 0, not -1"},
      {"vcm", "<float name='light_paths' value='1e9'/>",
       "more than 65536 light sub-paths for each pixel are too many"},
      {"bdpt", "<float name='light_paths' value='nan'/>", "not a finite number"},
      {"bdpt", "<string name='light_paths' value='many'/>", "is of type float, not a string"},
      {"bdpt", "<integer name='connections' value='-2'/>", "must be -1 or more, not -2"},
      {"vcm", "<integer name='connections' value='65537'/>",
       "more than 65536 connections of an eye vertex are too many"},
      {"bdpt", "<integer name='max_depth' value='-2'/>", "must be -1 or more, not -2"},
      {"bdpt", "<integer name='rr_depth' value='0'/>", "must be positive, not 0"},
      {"ppm", "<float name='radius' value='-0.5'/>", "must be at least 0, not -0.5"},
      {"bpm", "<float name='initial_radius' value='-0.5'/>", "must be at least 0, not -0.5"},
      {"vcm", "<float name='alpha' value='1.5'/>", "must be from 0 to 1, not 1.5"},
      {"sppm", "<float name='alpha' value='-1'/>", "must be from 0 to 1, not -1"},
      {"reuse", "<integer name='max_eye_depth' value='-1'/>", "must be at least 0, not -1"},
      {"reuse", "<integer name='max_light_depth' value='99999'/>",
       "more than 65536 segments of a sub-path are too many"},
      {"reuse", "<integer name='max_eye_depth' value='99999'/>",
       "more than 65536 segments of a sub-path are too many"},
      {"reuse", "<float name='continue_probability' value='0'/>",
       "must be above 0 and at most 1, not 0"},
      {"reuse", "<float name='continue_probability' value='1.5'/>",
       "must be above 0 and at most 1, not 1.5"},
      {"reuse", "<string name='weights' value='exac'/>",
       "cannot be \"exac\" (did you mean \"exact\"?); it is one of exact, thesis"},
      {"reuse", "<string name='thesis_reading' value='c'/>", "it is one of a, b"},
      {"reuse", "<string name='thesis_reading' value='a'/>",
       "\"thesis_reading\" is only for the \"weights\" \"thesis\""},
  };
  for (const Case& c : cases) {
    const std::string value = c.value;
    CAPTURE(value);
    const ReadResult r = read_integrator(
        "3.0.0", fmt::format("<integrator type='{}'>\n  {}</integrator>", c.type, value));
    CAPTURE(r.messages());
    CHECK(!r.scene);
    const size_t column = 3 + value.find("value=");
    CHECK(r.has(fmt::format("/scene/scene.xml:4:{}: error: ", column)));
    CHECK(r.has(c.message));
  }
  CHECK(read_integrator("0.6.0",
                        "<integrator type='ptracer'><boolean name='bruteForce' value='true'/>"
                        "</integrator>")
            .scene);
  CHECK(read_integrator("3.0.0",
                        "<integrator type='bdpt'><float name='light_path' value='1'/>"
                        "</integrator>")
            .has("(did you mean \"light_paths\"?)"));
}

TEST_CASE("bidirectional integrators survive being written and read again") {
  const auto check = [](const Bidirectional& d, const std::string& loss) {
    ReadResult r = read_integrator("3.0.0", "<integrator type='path'/>");
    SceneDescription scene = r.description();
    scene.integrator.method = d;
    const MitsubaXml xml = write_mitsuba_xml(scene);
    CAPTURE(xml.text);
    CHECK(xml.losses == (loss.empty() ? std::vector<std::string>{} : std::vector{loss}));
    const ReadResult again = read_text(xml.text);
    CHECK(again.messages() == "");
    REQUIRE(again.scene);
    CHECK(std::get<Bidirectional>(again.description().integrator.method) == d);
    CHECK(again.description() == scene);
    return xml.text;
  };
  const std::string text = check({.method = ptracer, .max_depth = 3, .hide_emitters = true}, "");
  // Mitsuba 3 stops at parameters that it does not know.
  CHECK(text.find("light_paths") == text.npos);
  check({.method = ptracer, .light_paths = 2},
        "only Duet reads \"light_paths\" of the integrator \"ptracer\"");
  check({.method = bdpt,
         .max_depth = 12,
         .rr_depth = 3,
         .hide_emitters = true,
         .strict_normals = true,
         .light_paths = 0.1,
         .connections = 5,
         .light_image = false},
        "only Duet reads the integrator \"bdpt\"");
  check({.method = ppm, .light_paths = 3, .radius = 0.01, .alpha = 0.7},
        "only Duet reads the integrator \"ppm\"");
  check({.method = bpm, .strict_normals = true, .radius = 1e-3, .alpha = 1},
        "only Duet reads the integrator \"bpm\"");
  check({.method = vcm,
         .light_selection = LightSelection::uniform,
         .connections = 0,
         .radius = 2,
         .alpha = 0.3},
        "only Duet reads the integrator \"vcm\"");
  for (const ReuseWeights weights :
       {ReuseWeights::exact, ReuseWeights::thesis_a, ReuseWeights::thesis_b})
    check({.method = reuse,
           .light_paths = 0.5,
           .max_eye_depth = 1,
           .max_light_depth = 6,
           .weights = weights,
           .continue_probability = 0.9},
          "only Duet reads the integrator \"reuse\"");
}
