// What duet render writes, in the form of what was asked for.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/workplace.h"
#include "image/image_io.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

double mean(const Image& image, const char* channel) {
  const int c = image.find_channel(channel);
  REQUIRE(c >= 0);
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += double(image.pixel(x, y)[c]);
  return sum / (double(image.width) * image.height);
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("a scene becomes an image here, with a summary and nothing on standard output") {
    const Workplace place;
    std::filesystem::create_directory(place.path("below"));
    place.scene("below/tiny.xml");
    const Outcome o = place.run({"below/tiny.xml"});
    CHECK(o.code == 0);
    CHECK(o.out.empty());
    CHECK(contains(o.err, "4 spp"));
    CHECK(contains(o.err, "-> tiny.exr"));
    const ImageFile file = read_image(place.path("tiny.exr"));
    CHECK(file.image.width == 16);
    CHECK(file.image.height == 12);
    CHECK(file.image.channels == std::vector<std::string>{"R", "G", "B"});
    CHECK(mean(file.image, "R") > 0.1);
    // The square's reflectance is in the ratio 4 : 2 : 1.
    CHECK(mean(file.image, "R") == doctest::Approx(2 * mean(file.image, "G")).epsilon(1e-2));
    CHECK(mean(file.image, "G") == doctest::Approx(2 * mean(file.image, "B")).epsilon(1e-2));
    const Outcome quiet = place.run({"render", "below/tiny.xml", "-q"});
    CHECK(quiet.code == 0);
    CHECK(quiet.err.empty());
  }

  TEST_CASE("templates and directories name images; several formats come from one render") {
    const Workplace place;
    place.scene();
    std::filesystem::create_directory(place.path("out"));
    const Outcome o = place.run({"-o", "out", "-o", "{scene}-{integrator}-{spp}-{seed}.png", "-o",
                                 "out/{scene}.JPG", "tiny.xml", "--seed", "7", "--spp", "3"});
    CHECK(o.code == 0);
    CHECK(place.has("out/tiny.exr"));
    CHECK(place.has("tiny-path-3-7.png"));
    CHECK(place.has("out/tiny.JPG"));
    CHECK(place.count() == 3);
    // The PNG shows the linear values in sRGB.
    const ImageFile linear = read_image(place.path("out/tiny.exr"));
    const ImageFile shown = read_image(place.path("tiny-path-3-7.png"));
    REQUIRE(shown.bytes.size() == size_t(16 * 12 * 3));
    for (int c = 0; c < 3; ++c) {
      const float expected = linear_to_srgb(linear.image.pixel(3, 5)[c]);
      CHECK(std::abs(float(shown.bytes[size_t((5 * 16 + 3) * 3 + c)]) - 255 * expected) < 1);
    }
  }

  TEST_CASE("tone mapping and automatic exposure change what is shown and nothing else") {
    const Workplace place;
    place.scene();
    const auto render = [&](const std::string& name, const std::vector<std::string>& options) {
      std::vector<std::string> all{"tiny.xml", "-o", name + ".exr", "-o", name + ".png"};
      all.insert(all.end(), options.begin(), options.end());
      CHECK(place.run(all).code == 0);
      return read_image(place.path(name + ".png")).bytes;
    };
    const auto plain = render("plain", {});
    // The geometric mean of luminance is middle grey: in sRGB 118 of 255.
    const auto automatic = render("auto", {"--exposure", "auto"});
    REQUIRE(automatic.size() == 16 * 12 * 3);
    double sum = 0;
    for (size_t i = 0; i < automatic.size(); i += 3) {
      const auto linear = [&](size_t c) { return srgb_to_linear(float(automatic[i + c]) / 255); };
      sum += std::log(double(Spectrum(linear(0), linear(1), linear(2)).luminance()));
    }
    CHECK(std::exp(sum / (16 * 12)) == doctest::Approx(0.18).epsilon(0.02));
    CHECK(render("brighter", {"--exposure", "auto+1"})[0] > automatic[0]);
    for (const std::string curve : {"aces", "agx", "reinhard"})
      CHECK(render(curve, {"--tonemap", curve}) != plain);
    CHECK(render("srgb", {"--tonemap", "srgb"}) == plain);
    CHECK(read_image(place.path("agx.exr")).image.data ==
          read_image(place.path("plain.exr")).image.data);
    for (const char* wrong : {"auto2", "auto+", "bright"})
      CHECK(place.run({"tiny.xml", "--exposure", wrong}).code == 2);
    CHECK(place.run({"tiny.xml", "--tonemap", "filmic"}).code == 2);
  }

  TEST_CASE("exposure brightens what is shown and nothing else") {
    const Workplace place;
    place.scene();
    CHECK(place.run({"tiny.xml", "-o", "a.exr", "-o", "a.png", "--exposure", "-2"}).code == 0);
    CHECK(place.run({"tiny.xml", "-o", "b.exr", "-o", "b.png"}).code == 0);
    CHECK(read_image(place.path("a.exr")).image.data == read_image(place.path("b.exr")).image.data);
    const ImageFile a = read_image(place.path("a.png")), b = read_image(place.path("b.png"));
    const float dark = srgb_to_linear(float(a.bytes[0]) / 255);
    const float bright = srgb_to_linear(float(b.bytes[0]) / 255);
    CHECK(dark == doctest::Approx(0.25f * bright).epsilon(0.05));
  }

  TEST_CASE("a window has its place in the header and the pixels of the whole image") {
    const Workplace place;
    place.scene();
    CHECK(place.run({"tiny.xml", "-o", "full.exr"}).code == 0);
    CHECK(place.run({"tiny.xml", "-o", "window.exr", "--crop", "5,2,7,6"}).code == 0);
    const ImageFile full = read_image(place.path("full.exr"));
    const ImageFile window = read_image(place.path("window.exr"));
    CHECK(window.image.width == 7);
    CHECK(window.image.height == 6);
    CHECK(window.origin.x == 5);
    CHECK(window.origin.y == 2);
    CHECK(window.display_size.x == 16);
    CHECK(window.display_size.y == 12);
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 7; ++x)
        CHECK(window.image.pixel(x, y)[0] == full.image.pixel(x + 5, y + 2)[0]);
  }

  TEST_CASE("colours of a PNG are not multiplied by its alpha") {
    const Workplace place;
    // A lamp in front of nothing: what it covers in part has its colour, too.
    place.write("lamp.xml", R"(<scene version="3.0.0"><integrator type="path"/>
      <sensor type="perspective"><float name="fov" value="90"/>
        <transform name="to_world"><lookat origin="0,0,2" target="0,0,0" up="0,1,0"/></transform>
        <sampler type="independent"><integer name="sample_count" value="64"/></sampler>
        <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/>
          <string name="pixel_format" value="rgba"/><rfilter type="box"/></film></sensor>
      <shape type="disk"><emitter type="area"><rgb name="radiance" value="0.5"/></emitter></shape>
      </scene>)");
    REQUIRE(place.run({"lamp.xml", "-o", "lamp.png"}).code == 0);
    const ImageFile shown = read_image(place.path("lamp.png"));
    REQUIRE(shown.image.channel_count() == 4);
    int covered_in_part = 0;
    for (size_t i = 0; i < shown.bytes.size(); i += 4) {
      const uint8_t alpha = shown.bytes[i + 3];
      covered_in_part += alpha > 0 && alpha < 255;
      if (alpha > 0) CHECK(std::abs(int(shown.bytes[i]) - 188) <= 1);  // sRGB of one half
    }
    CHECK(covered_in_part >= 12);
  }

  TEST_CASE("the film decides on half or float and on the channels") {
    const Workplace place;
    const auto film = [](const std::string& format, const std::string& component) {
      TinyScene s;
      s.film =
          "<film type=\"hdrfilm\"><integer name=\"width\" value=\"16\"/><integer "
          "name=\"height\" value=\"12\"/><string name=\"pixel_format\" value=\"" +
          format + "\"/><string name=\"component_format\" value=\"" + component + "\"/></film>";
      return s;
    };
    const std::pair<const char*, std::vector<std::string>> formats[] = {
        {"rgb", {"R", "G", "B"}}, {"rgba", {"R", "G", "B", "A"}},
        {"luminance", {"Y"}},     {"luminance_alpha", {"Y", "A"}},
        {"xyz", {"X", "Y", "Z"}}, {"xyza", {"X", "Y", "Z", "A"}}};
    for (const auto& [format, channels] : formats) {
      SHOW(format);
      place.scene("tiny.xml", film(format, "float32"));
      const Outcome o = place.run({"tiny.xml", "-o", "a.exr", "-o", "a.png"});
      CAPTURE(o.err);
      CHECK(o.code == 0);
      const ImageFile file = read_image(place.path("a.exr"));
      std::vector<std::string> sorted = file.image.channels, expected = channels;
      std::sort(sorted.begin(), sorted.end());
      std::sort(expected.begin(), expected.end());
      CHECK(sorted == expected);
      const bool grey = channels[0] == std::string("Y"), alpha = channels.back() == "A";
      const ImageFile shown = read_image(place.path("a.png"));
      CHECK(shown.image.channel_count() == (grey ? 1 : 3) + alpha);
      if (alpha) CHECK(shown.bytes.back() == 255);
      const Imf::InputFile exr(place.path("a.exr").c_str());
      CHECK(exr.header().channels().begin().channel().type == Imf::FLOAT);
    }
    place.scene("tiny.xml", film("rgb", "float16"));
    CHECK(place.run({"tiny.xml", "-o", "h.exr"}).code == 0);
    const Imf::InputFile half(place.path("h.exr").c_str());
    CHECK(half.header().channels().begin().channel().type == Imf::HALF);
  }

  TEST_CASE("statistics have their keys") {
    const Workplace place;
    place.scene("tiny.xml");
    place.scene("other.xml");
    CHECK(place.run({"tiny.xml", "--stats", "s.json", "-t", "2", "--seed", "5"}).code == 0);
    const auto j = nlohmann::json::parse(read_file(place.path("s.json")));
    for (const char* key :
         {"scene", "integrator", "spp", "seed", "threads", "seconds", "memory_peak_bytes", "rays",
          "paths", "mean_path_length", "connections", "merges", "eye_subpaths_at_limit",
          "reused_subpaths", "nonfinite_samples", "error", "emitters", "triangles", "instances"}) {
      CAPTURE(key);
      CHECK(j.contains(key));
    }
    CHECK(j["medium_steps"] == 0);
    CHECK(j["scene"] == "tiny.xml");
    CHECK(j["spp"] == 4);
    CHECK(j["seed"] == 5);
    CHECK(j["threads"] == 2);
    CHECK(j["seconds"]["render"] > 0);
    for (const char* phase : {"parse", "build", "write"}) CHECK(j["seconds"][phase] >= 0);
    CHECK(j["memory_peak_bytes"] > 1000000);
    CHECK(j["paths"]["camera"] == 16 * 12 * 4);
    CHECK(j["paths"]["light"] == 0);
    CHECK(j["rays"]["closest"] >= 16 * 12 * 4);
    CHECK(j["rays"]["shadow"] > 0);
    CHECK(j["emitters"] == 1);
    CHECK(j["triangles"] == 2);
    CHECK(j["instances"] == 0);
    CHECK(j["nonfinite_samples"] == 0);
    CHECK(j["error"]["relative_standard_error"] > 0);
    CHECK(j["error"]["relative_rmse_estimate"] == j["error"]["relative_standard_error"]);
    CHECK(place.run({"tiny.xml", "other.xml", "--stats", "s.json"}).code == 0);
    const auto both = nlohmann::json::parse(read_file(place.path("s.json")));
    REQUIRE(both.is_array());
    REQUIRE(both.size() == 2);
    CHECK(both[1]["scene"] == "other.xml");
  }

  TEST_CASE("a scene that names no method gets one that suits it, and the image says which") {
    const Workplace place;
    TinyScene s;
    s.integrator = "";
    place.scene("tiny.xml", s);
    const Outcome o = place.run({"tiny.xml", "--stats", "s.json", "-o", "{integrator}.exr"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    CHECK(contains(o.err, "tiny.xml: auto chose "));
    const auto j = nlohmann::json::parse(read_file(place.path("s.json")));
    CHECK(j["integrator"] == "auto");
    const std::string reason = j["chosen"]["reason"];
    CHECK(contains(o.err, "auto chose " + reason));
    const ImageFile file = read_image(place.path("auto.exr"));
    std::map<std::string, std::string> header(file.header.begin(), file.header.end());
    CHECK(header["integrator"] == "auto");
    CHECK(header["chosenIntegrator"] == j["chosen"]["integrator"]);
    CHECK(header["chosenParameters"] == j["chosen"]["parameters"]);
    CHECK(header["choiceReason"] == reason);
    CHECK(reason.rfind(header["chosenIntegrator"], 0) == 0);
    // The same picture as by the method that was chosen.
    const std::string name = j["chosen"]["integrator"];
    std::vector<std::string> again{"tiny.xml", "-i", name, "-o", "b.exr"};
    std::istringstream parameters(j["chosen"]["parameters"].get<std::string>());
    for (std::string p; parameters >> p;) again.insert(again.end(), {"-I", p});
    REQUIRE(place.run(again).code == 0);
    CHECK(read_image(place.path("b.exr")).image.data == file.image.data);
    CHECK(place.run({"tiny.xml", "--strict"}).code == 1);
    CHECK(place.run({"tiny.xml", "-i", "auto", "-I", "light_paths=1"}).code == 2);
  }

  TEST_CASE("layers are asked for by name and come after the colours") {
    const Workplace place;
    place.scene();
    const Outcome o = place.run({"--aov", "albedo,depth,normal,samples", "tiny.xml", "--aov",
                                 "albedo,variance", "--size", "8x8"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const ImageFile file = read_image(place.path("tiny.exr"));
    const Image& image = file.image;
    CHECK(image.channel_count() == 3 + 3 + 1 + 3 + 1 + 3);
    CHECK(mean(image, "albedo.R") == doctest::Approx(0.8).epsilon(1e-3));
    CHECK(mean(image, "albedo.B") == doctest::Approx(0.2).epsilon(1e-3));
    CHECK(mean(image, "depth.T") > 2);
    CHECK(mean(image, "depth.T") < 3.5);
    CHECK(mean(image, "normal.Z") == doctest::Approx(1));
    CHECK(mean(image, "samples.I") == 4);
    CHECK(mean(image, "variance.R") > 0);
    CHECK(place.run({"tiny.xml", "-i", "aov", "--aov", "uv", "-o", "uv.exr"}).code == 0);
    CHECK(read_image(place.path("uv.exr")).image.find_channel("R") < 0);
  }

  TEST_CASE("layers that no image could hold are refused, not lost") {
    const Workplace place;
    place.scene();
    const Outcome lost = place.run({"tiny.xml", "--aov", "depth,uv", "-o", "a.png"});
    CHECK(lost.code == 2);
    CHECK(lost.err.find("-o a.png: only .exr files can hold the other layers (depth.T, …)") !=
          std::string::npos);
    CHECK(!place.has("a.png"));
    CHECK(place.run({"tiny.xml", "-i", "bdpt", "-I", "max_depth=3", "--techniques", "-o", "a.png"})
              .code == 2);
    CHECK(place.run({"tiny.xml", "--aov", "depth", "-o", "a.png", "-o", "a.exr"}).code == 0);
    CHECK(place.has("a.png"));
    CHECK(place.run({"tiny.xml", "-o", "b.png"}).code == 0);
  }

  TEST_CASE("a sensor is chosen by its number") {
    const Workplace place;
    TinyScene s;
    s.extra = R"(<sensor type="orthographic"><film type="hdrfilm">
      <integer name="width" value="9"/><integer name="height" value="5"/></film></sensor>)";
    place.scene("two.xml", s);
    CHECK(place.run({"two.xml", "-s", "1"}).code == 0);
    CHECK(read_image(place.path("two.exr")).image.width == 9);
    CHECK(place.run({"two.xml", "-s", "2"}).code == 2);
  }

  TEST_CASE("definitions, folders and methods of the command line win over the scene") {
    const Workplace place;
    place.scene();
    std::filesystem::create_directory(place.path("parts"));
    place.write("parts/lamp.xml", R"(<scene version="3.0.0"><emitter type="constant"/></scene>)");
    TinyScene s;
    s.extra = "<include filename=\"lamp.xml\"/>";
    place.scene("incomplete.xml", s);
    CHECK(place.run({"incomplete.xml"}).code == 1);
    CHECK(place.run({"incomplete.xml", "-a", "parts"}).code == 0);
    CHECK(place.run({"tiny.xml", "-Dspp=9", "-o", "{integrator}{spp}.exr", "-i", "direct"}).code ==
          0);
    CHECK(place.has("direct9.exr"));
  }

  TEST_CASE("indices of shapes are exact in films of half floats") {
    const Workplace place;
    TinyScene s;
    // Behind the camera, but for the last.
    for (int i = 0; i < 2100; ++i)
      s.extra +=
          "<shape type=\"sphere\"><point name=\"center\" value=\"0,0,9\"/><float name=\"radius\" "
          "value=\"0.01\"/></shape>";
    s.extra += "<shape type=\"sphere\"><float name=\"radius\" value=\"0.5\"/></shape>";
    place.scene("many.xml", s);
    const Outcome o = place.run({"many.xml", "--spp", "1", "--aov", "shape,depth,samples"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const Image image = read_image(place.path("many.exr")).image;
    CHECK(image.pixel(8, 6)[image.find_channel("shape.I")] == 2101);
    const float depth = image.pixel(8, 6)[image.find_channel("depth.T")];
    REQUIRE(depth > 1);
    REQUIRE(depth < 2);
    CHECK(std::floor(depth * 1024) != depth * 1024);  // the steps of half floats there
  }

  TEST_CASE("an old film's tone mapping is for display formats") {
    const Workplace place;
    const auto shown = [&](const std::string& film) {
      TinyScene s;
      s.version = "0.6.0";
      s.film =
          "<film type=\"ldrfilm\"><integer name=\"width\" value=\"16\"/><integer "
          "name=\"height\" value=\"12\"/>" +
          film + "</film>";
      place.scene("old.xml", s);
      const Outcome o = place.run({"old.xml", "-o", "old.png", "-o", "old.exr"});
      CAPTURE(o.err);
      REQUIRE(o.code == 0);
      return std::pair(srgb_to_linear(float(read_image(place.path("old.png")).bytes[0]) / 255),
                       read_image(place.path("old.exr")).image.pixel(0, 0)[0]);
    };
    const auto [plain, radiance] = shown("");
    const auto [darker, same] = shown("<float name=\"exposure\" value=\"-1\"/>");
    CHECK(radiance == same);
    CHECK(darker == doctest::Approx(0.5f * plain).epsilon(0.05));
    const auto [curve, again] = shown("<float name=\"gamma\" value=\"1\"/>");
    CHECK(linear_to_srgb(curve) == doctest::Approx(radiance).epsilon(0.05));
  }
}
