// duet info and duet plugins.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "evaluate/report/vocabulary_text.h"
#include "mitsuba/vocabulary.h"
#include "scene/mitsuba_differences.h"

using namespace duet;
using namespace duet::test;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

TinyScene rich_scene() {
  TinyScene s;
  s.extra = R"(<bsdf type="roughconductor" id="copper"><string name="material" value="Cu"/>
      <string name="distribution" value="ggx"/><float name="alpha" value="0.3"/></bsdf>
    <shape type="sphere" id="ball"><point name="center" x="1" y="2" z="10"/>
      <ref id="copper"/></shape>
    <shape type="shapegroup" id="pair"><shape type="cube"/><shape type="disk"/></shape>
    <shape type="instance"><ref id="pair"/></shape>
    <shape type="instance"><ref id="pair"/><transform name="to_world">
      <translate x="-20"/></transform></shape>
    <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="3,2,1"/></emitter>
      <bsdf type="mask"><float name="opacity" value="0.25"/><bsdf type="dielectric"/></bsdf></shape>
    <emitter type="constant"/>)";
  return s;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("-i takes the place of an integrator that nobody knows") {
    const Workplace place;
    TinyScene s;
    s.integrator =
        "<integrator type='path_sms_ss'><integer name='max_depth' value='3'/></integrator>";
    place.scene("fork.xml", s);
    const Outcome refused = place.run({"fork.xml", "-o", "a.exr"});
    CHECK(refused.code == 1);
    CHECK(has(refused.err, "-i METHOD renders the scene with another one"));
    const Outcome rendered = place.run({"fork.xml", "-i", "path", "--spp", "1", "-o", "a.exr"});
    CHECK(rendered.code == 0);
    CHECK(has(rendered.err, "\"path_sms_ss\" is unknown: path takes its place"));
    CHECK(place.has("a.exr"));
    CHECK(place.run({"fork.xml", "-i", "path", "--strict", "-o", "b.exr"}).code == 1);
    const Outcome info = place.run({"info", "fork.xml", "-i", "bdpt"});
    CHECK(info.code == 0);
    CHECK(has(info.out, "bdpt: max_depth=3"));
  }

  TEST_CASE("warnings of one kind are one line, and all of them with -v") {
    const Workplace place;
    TinyScene s;
    for (int i = 0; i < 3; ++i)
      s.extra += "<shape type='cube'><float name='odd' value='1'/></shape>\n";
    place.scene("odd.xml", s);
    const Outcome few = place.run({"info", "odd.xml"});
    CHECK(has(few.err, "\"odd\" of <shape type=\"cube\"> (3 times)"));
    CHECK(std::count(few.err.begin(), few.err.end(), '\n') == 1);
    const Outcome all = place.run({"info", "odd.xml", "-v"});
    CHECK(std::count(all.err.begin(), all.err.end(), '\n') == 3);
    CHECK(!has(all.err, "times"));
    CHECK(place.run({"info", "odd.xml", "--strict"}).code == 1);
  }

  TEST_CASE("info tells what a scene contains") {
    const Workplace place;
    place.scene("rich.xml", rich_scene());
    const Outcome o = place.run({"info", "rich.xml", "-D", "spp=12"});
    CAPTURE(o.err);
    CAPTURE(o.out);
    CHECK(o.code == 0);
    CHECK(place.count() == 1);
    for (const char* part : {"rich.xml",
                             "$spp = 12",
                             "path: max_depth=4",
                             "perspective at (0, 0, 2)",
                             "fov 90 along x",
                             "16x12, rgb float16, box filter of radius 0.5",
                             "independent, 12 samples",
                             "2 instance, 2 rectangle, 1 sphere",
                             "sphere ball, bsdf copper",
                             "(28 triangles in all copies)",
                             "from (-21, -3, -1) to (3, 3",
                             "copper: roughconductor (ggx, alpha 0.3)",
                             "mask, opacity 0.25 [dielectric",
                             "emits 3 2 1",
                             "diffuse 0.8 0.4 0.2",
                             "area on rectangle",
                             "point at (0, 0, 3): 20",
                             "constant: 1",
                             "instance of pair",
                             "modelled",
                             "transparent surfaces",
                             "methods       light sub-paths are needed",
                             "approximated  nothing"}) {
      CAPTURE(part);
      CHECK(contains(o.out, part));
    }
  }

  TEST_CASE("info says what is approximated, and cuts long lists") {
    const Workplace place;
    TinyScene s;
    s.version = "0.6.0";
    s.extra =
        R"(<bsdf type="roughconductor" id="r"><string name="distribution" value="phong"/></bsdf>)";
    for (int i = 0; i < 30; ++i) s.extra += "<shape type=\"sphere\"><ref id=\"r\"/></shape>";
    place.scene("many.xml", s);
    const Outcome o = place.run({"info", "many.xml"});
    CHECK(o.code == 0);
    CHECK(contains(o.out, "many.xml:"));
    CHECK(contains(o.out, "Phong"));
    CHECK(contains(o.out, "and 19 more (-v lists all)"));
    const Outcome all = place.run({"info", "many.xml", "-v"});
    CHECK(!contains(all.out, "more (-v"));
    CHECK(all.out.size() > o.out.size());
  }

  TEST_CASE("info names what Mitsuba renders wrongly, if a scene has it") {
    const Workplace place;
    TinyScene s;
    s.integrator = R"(<integrator type="direct"><integer name="emitter_samples" value="3"/>
      </integrator>)";
    place.scene("three.xml", s);
    place.scene();
    const Outcome three = place.run({"info", "three.xml"});
    CAPTURE(three.out);
    CHECK(contains(three.out,
                   "differs from Mitsuba 1: by how much is in docs/compatibility.md\n"
                   "    direct-delta-lights: Mitsuba 3.9.1 adds"));
    CHECK(!contains(place.run({"info", "tiny.xml"}).out, "differs"));
  }

  TEST_CASE("info as JSON says the same") {
    const Workplace place;
    TinyScene rich = rich_scene();
    rich.extra += "<emitter type=\"point\"><float name=\"brightnes\" value=\"1\"/></emitter>";
    place.scene("rich.xml", rich);
    const Outcome o = place.run({"info", "rich.xml", "--json", "-D", "spp=12"});
    CAPTURE(o.err);
    CAPTURE(o.out);
    REQUIRE(o.code == 0);
    const auto j = nlohmann::json::parse(o.out);
    CHECK(j["file"] == "rich.xml");
    CHECK(j["name"] == "rich");
    CHECK(j["version"] == "3.0.0");
    CHECK(j["parameters"]["spp"] == "12");
    CHECK(j["integrator"]["name"] == "path");
    CHECK(contains(j["integrator"]["parameters"], "max_depth=4 rr_depth=2"));
    const auto& sensor = j["sensors"].at(0);
    CHECK(sensor["type"] == "perspective");
    CHECK(sensor["width"] == 16);
    CHECK(sensor["height"] == 12);
    CHECK(sensor["spp"] == 12);
    CHECK(sensor["crop"].is_null());
    CHECK(j["shapes"]["count"] == 5);
    CHECK(j["shapes"]["kinds"]["instance"] == 2);
    CHECK(j["shapes"]["triangles_in_all_copies"] == 28);
    CHECK(j["shapes"]["bounds"]["lower"][0] == doctest::Approx(-21));
    CHECK(j["shape_groups"].at(0)["shapes"].size() == 2);
    CHECK(j["bsdfs"].size() == 4);
    CHECK(j["media"].empty());
    CHECK(j["lights"].size() == 4);
    CHECK(j["rules"]["needs_light_walks"] == true);
    CHECK(j["methods"].size() >= 8);
    for (const auto& m : j["methods"]) {
      CHECK(m["renders"] == m["obstacle"].is_null());
      CHECK(m["renders"] == (m["name"] != "aov"));  // which needs layers
    }
    CHECK(j["approximated"].empty());
    REQUIRE(j["warnings"].size() == 1);
    CHECK(contains(j["warnings"][0]["message"], "brightnes"));
    CHECK(j["warnings"][0]["file"] == "rich.xml");
    CHECK(j["warnings"][0]["line"] > 0);
  }

  TEST_CASE("info as JSON names obstacles and failures, and is valid for every file name") {
    const Workplace place;
    TinyScene medium;
    medium.extra = R"(<shape type="sphere"><medium type="homogeneous" name="interior"/></shape>)";
    const std::string name = "caf\xe9 \"x\".xml";  // no UTF-8
    place.scene(name, medium);
    place.write("bad.xml", "<scene version=\"3.0.0\">\n<shap/></scene>");
    const Outcome o = place.run({"info", name, "bad.xml", "--json"});
    CHECK(o.code == 1);
    CAPTURE(o.out);
    const auto list = nlohmann::json::parse(o.out);
    REQUIRE(list.size() == 2);
    CHECK(list[0]["file"] == "caf\xef\xbf\xbd \"x\".xml");
    std::string without;
    for (const auto& m : list[0]["methods"])
      if (m["renders"] == false) without += m["name"].get<std::string>() + " ";
    CHECK(contains(without, "ppm"));
    CHECK(!contains(without, "volpath"));
    CHECK(list[1]["file"] == "bad.xml");
    CHECK(contains(list[1]["error"], "bad.xml:2:1: unknown element"));
    CHECK(place.run({name, "--stats", "s.json"}).code == 0);
    CHECK(nlohmann::json::accept(read_file(place.path("s.json"))));
  }

  TEST_CASE("info of a scene whose method is still to be chosen") {
    const Workplace place;
    place.scene();
    const Outcome o = place.run({"info", "tiny.xml", "-i", "auto"});
    CHECK(o.code == 0);
    CHECK(contains(o.out, "about "));
  }

  TEST_CASE("info goes on after a bad scene") {
    const Workplace place;
    place.scene();
    place.write("bad.xml", "<scene>");
    const Outcome o = place.run({"info", "bad.xml", "missing.xml", "tiny.xml"});
    CHECK(o.code == 1);
    CHECK(contains(o.out, "tiny.xml"));
    CHECK(contains(o.err, "bad.xml"));
    CHECK(contains(o.err, "missing.xml"));
  }

  TEST_CASE("info writes a scene that renders the same image") {
    const Workplace place;
    place.scene("rich.xml", rich_scene());
    const Outcome o = place.run({"info", "rich.xml", "--xml", "-D", "spp=2"});
    CHECK(o.code == 0);
    place.write("again.xml", o.out);
    CHECK(place.run({"rich.xml", "--spp", "2"}).code == 0);
    const Outcome rendered = place.run({"again.xml"});
    CAPTURE(rendered.err);
    REQUIRE(rendered.code == 0);
    const Outcome compared =
        place.run({"compare", "again.exr", "rich.exr", "--require", "rmse<1e-3"});
    CHECK(compared.code == 0);
  }

  TEST_CASE("plugins lists everything that is known") {
    const Workplace place;
    const Outcome all = place.run({"plugins"});
    CHECK(all.code == 0);
    for (int k = 0; k < kPluginKinds; ++k) {
      if (PluginKind(k) == PluginKind::scene) continue;
      for (const Plugin& p : Vocabulary::built_in().plugins(PluginKind(k))) {
        CAPTURE(p.name);
        CHECK(contains(all.out,
                       std::string(tag_of(PluginKind(k))) + " " + std::string(p.name) + " "));
        for (const Parameter& q : p.parameters) CHECK(contains(all.out, std::string(q.name)));
      }
    }
    const Outcome bsdf = place.run({"plugins", "bsdf"});
    CHECK(contains(bsdf.out, "bsdf roughconductor"));
    CHECK(!contains(bsdf.out, "emitter"));
    const Outcome markdown = place.run({"plugins", "--markdown"});
    CHECK(markdown.out == compatibility_markdown() + "\n" + mitsuba_differences_markdown());
  }
}
