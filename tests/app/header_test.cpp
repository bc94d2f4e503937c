// What the header of an EXR file says about the image.
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>

#include "app/workplace.h"
#include "image/image_facts.h"
#include "image/image_io.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

std::map<std::string, std::string> header_of(const ImageFile& file) {
  return {file.header.begin(), file.header.end()};
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the header says how the image was made") {
    const Workplace place;
    place.scene("a scene.xml");
    CHECK(place
              .run({"a scene.xml", "-o", "a.exr", "--seed", "9", "-t", "1", "-I", "max_depth=3",
                    "--spp", "8"})
              .code == 0);
    auto h = header_of(read_image(place.path("a.exr")));
    CHECK(h["program"] == "Duet");
    CHECK(h["version"] == DUET_VERSION);
    CHECK(h["commandLine"] == "duet 'a scene.xml' -o a.exr --seed 9 -t 1 -I max_depth=3 --spp 8");
    CHECK(h["scene"] == "a scene.xml");
    CHECK(h["sceneHash"].size() == 16);
    CHECK(h["integrator"] == "path");
    CHECK(contains(h["integratorParameters"], "max_depth=3 rr_depth=2"));
    CHECK(h["sampler"] == "sobol");
    CHECK(std::stod(h["spp"]) == 8);
    CHECK(h.contains("lightSubpaths"));
    CHECK(h["seed"] == "9");
    CHECK(std::stod(h["threads"]) == 1);
    CHECK(std::stod(h["renderSeconds"]) > 0);
    CHECK(std::stod(h["relativeStandardError"]) > 0);
    CHECK(h["relativeRmseEstimate"] == h["relativeStandardError"]);
    place.write("a scene.xml", TinyScene().text() + "<!-- another -->");
    CHECK(place.run({"a scene.xml", "-o", "b.exr", "--strict-sampler"}).code == 0);
    auto other = header_of(read_image(place.path("b.exr")));
    CHECK(other["sceneHash"] != h["sceneHash"]);
    CHECK(other["sampler"] == "independent");
  }

  TEST_CASE("the header says nothing of the machine or the user") {
    const Workplace place, elsewhere;
    place.scene("tiny.xml");
    elsewhere.scene("far.xml");
    const std::string here = place.path("tiny.xml"), there = elsewhere.path("far.xml");
    for (const std::string& scene : {here, there}) {
      const Outcome o = place.run({scene, "-o", elsewhere.path("a.exr"), "-o" + place.path("a.png"),
                                   "--log=" + elsewhere.path("log.txt")});
      CAPTURE(o.err);
      REQUIRE(o.code == 0);
      for (const std::string& image : {elsewhere.path("a.exr"), place.path("a.png")}) {
        auto facts = read_image_facts(image);
        const std::string name = scene == here ? "tiny.xml" : "far.xml";
        CHECK(facts.field("scene") == name);
        CHECK(facts.field("commandLine") == "duet " + name + " -o a.exr -oa.png --log=log.txt");
        for (const auto& [field, value] : facts.fields) {
          SHOW(field);
          CHECK(!contains(value, place.path("")));
          CHECK(!contains(value, elsewhere.path("")));
        }
      }
    }
  }

  TEST_CASE("the header has the date, unless files are to be equal") {
    const Workplace place;
    place.scene("tiny.xml");
    CHECK(place.run({"tiny.xml"}).code == 0);
    const std::string date = read_image_facts(place.path("tiny.exr")).field("date");
    REQUIRE(date.size() == 20);
    CHECK(date > "2024-01-01T00:00:00Z");
    CHECK(date[10] == 'T');
    CHECK(date[19] == 'Z');
    const ProcessOptions fixed{.directory = place.path(""),
                               .environment = {{"SOURCE_DATE_EPOCH", "1000000000"}}};
    std::string first[3];
    for (const bool again : {false, true}) {
      CHECK(run_duet({"tiny.xml", "-o", "a.exr", "-o", "a.png", "-o", "a.jpg"}, fixed).code == 0);
      for (int i = 0; i < 3; ++i) {
        const std::string path = place.path(std::array{"a.exr", "a.png", "a.jpg"}[size_t(i)]);
        CHECK(read_image_facts(path).field("date") == "2001-09-09T01:46:40Z");
        if (!again) first[i] = read_file(path);
        CHECK(read_file(path) == first[i]);
      }
    }
  }

  TEST_CASE("PNG and JPEG files say the same as EXR files") {
    const Workplace place;
    place.scene("tiny.xml");
    CHECK(
        place.run({"tiny.xml", "-o", "a.exr", "-o", "a.png", "-o", "a.jpg", "--seed", "9"}).code ==
        0);
    const ImageFacts exr = read_image_facts(place.path("a.exr"));
    CHECK(exr.field("seed") == "9");
    for (const char* name : {"a.png", "a.jpg"}) {
      const ImageFacts shown = read_image_facts(place.path(name));
      for (const char* field : {"program", "version", "commandLine", "scene", "sceneHash",
                                "integrator", "integratorParameters", "sampler", "spp", "seed"}) {
        CAPTURE(field);
        CHECK(!shown.field(field).empty());
        CHECK(shown.field(field) == exr.field(field));
      }
      // It is still an image.
      CHECK(read_image(place.path(name)).bytes.size() == 16 * 12 * 3);
    }
  }

  TEST_CASE("the header's matrices say where a point of the world is in the image") {
    const Workplace place;
    for (const char* type : {"perspective", "orthographic"}) {
      CAPTURE(type);
      const bool perspective = type == std::string("perspective");
      TinyScene s;
      // A small lamp, seen by a camera that looks from the side.
      place.write("lamp.xml",
                  std::string(R"(<scene version="3.0.0"><integrator type="direct"/>
        <sensor type=")") +
                      type + R"("><transform name="to_world">)" +
                      (perspective ? "" : "<scale x=\"4\" y=\"4\"/>") +
                      R"(<lookat origin="7,1,-2" target="0,0,0" up="0,0.2,1"/></transform>)" +
                      (perspective ? R"(<float name="fov" value="50"/>
            <float name="principal_point_offset_x" value="0.1"/>
            <float name="principal_point_offset_y" value="-0.07"/>)"
                                   : "") +
                      R"(
        <film type="hdrfilm"><integer name="width" value="120"/>
          <integer name="height" value="80"/><rfilter type="box"/></film></sensor>
        <shape type="sphere"><point name="center" x="0.5" y="-0.9" z="0.4"/>
          <float name="radius" value="0.08"/><emitter type="area"/></shape></scene>)");
      const Outcome o = place.run({"lamp.xml", "--spp", "16"});
      CAPTURE(o.err);
      REQUIRE(o.code == 0);
      const Image image = read_image(place.path("lamp.exr")).image;
      double x = 0, y = 0, weight = 0;
      for (int j = 0; j < image.height; ++j)
        for (int i = 0; i < image.width; ++i) {
          const double w = double(image.pixel(i, j)[1]);
          x += w * (i + 0.5), y += w * (j + 0.5), weight += w;
        }
      REQUIRE(weight > 0);
      const Imf::InputFile file(place.path("lamp.exr").c_str());
      const auto& to_ndc = file.header().typedAttribute<Imf::M44fAttribute>("worldToNDC").value();
      const auto& to_camera =
          file.header().typedAttribute<Imf::M44fAttribute>("worldToCamera").value();
      Imath::V3f ndc, camera;
      to_ndc.multVecMatrix(Imath::V3f(0.5f, -0.9f, 0.4f), ndc);
      to_camera.multVecMatrix(Imath::V3f(0.5f, -0.9f, 0.4f), camera);
      CHECK(double(ndc.x) * image.width == doctest::Approx(x / weight).epsilon(0.01));
      CHECK(double(ndc.y) * image.height == doctest::Approx(y / weight).epsilon(0.01));
      CHECK(camera.z > 0);
      if (!perspective) {
        CHECK((camera.x > 0) == (x / weight > 60));
        CHECK((camera.y > 0) == (y / weight < 40));
      }
    }
  }
}
