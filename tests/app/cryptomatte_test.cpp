// --cryptomatte: what is in the files, and what is refused.
#include <doctest/doctest.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "image/cryptomatte.h"
#include "image/image_io.h"

using namespace duet;
using namespace duet::test;

namespace {

/// The square fills the image, but for a ball with a name.
TinyScene scene_with_ball() {
  TinyScene s;
  s.extra = R"(<shape type="sphere" id="ball"><float name="radius" value="0.5"/>
    <bsdf type="diffuse" id="ball's &quot;paint&quot;"/></shape>)";
  return s;
}

std::string field(const ImageFile& file, const std::string& ending) {
  for (const auto& [name, value] : file.header)
    if (name.starts_with(kMatteFields) && name.ends_with(ending)) return value;
  return "";
}

/// Checks that coverages add up to one everywhere and that ids are those of `names`.
void check_ids(const Image& image, MatteKind kind, const std::vector<std::string>& names) {
  std::vector<int> channels;
  for (const std::string& name : matte_channels(kind)) {
    channels.push_back(image.find_channel(name));
    REQUIRE(channels.back() >= 0);
  }
  std::vector<uint32_t> ids;
  for (const std::string& name : names) ids.push_back(matte_id(name));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.pixel(x, y);
      float sum = 0;
      for (size_t rank = 0; rank < kMatteRanks; ++rank) {
        const float coverage = p[channels[2 * rank + 1]];
        sum += coverage;
        if (coverage > 0)
          CHECK(std::count(ids.begin(), ids.end(),
                           std::bit_cast<uint32_t>(p[channels[2 * rank]])) == 1);
      }
      CHECK(sum == 1);
    }
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("mattes are layers of 32 bits, and the header says how to read them") {
    const Workplace place;
    place.scene("ball.xml", scene_with_ball());
    const Outcome o = place.run(
        {"ball.xml", "--cryptomatte", "object,material", "--aov", "depth", "-o", "a.exr"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const ImageFile file = read_image(place.path("a.exr"));
    const std::string paint = "ball's \"paint\"";
    check_ids(file.image, MatteKind::object, {"shape#0", "ball"});
    check_ids(file.image, MatteKind::material, {"material#0", paint});
    CHECK(file.image.find_channel("depth.T") >= 0);

    for (const MatteKind kind : {MatteKind::object, MatteKind::material}) {
      const std::string name = matte_name(kind);
      char key[8];
      snprintf(key, sizeof key, "%07x", unsigned(murmur3_32(name) >> 4));
      const std::string path = key;
      CAPTURE(path);
      CHECK(field(file, path + "/name") == name);
      CHECK(field(file, path + "/hash") == "MurmurHash3_32");
      CHECK(field(file, path + "/conversion") == "uint32_to_float32");
      const auto manifest = nlohmann::json::parse(field(file, path + "/manifest"));
      CHECK(manifest.size() == 2);
      const std::string thing = kind == MatteKind::object ? "ball" : paint;
      REQUIRE(manifest.contains(thing));
      CHECK(std::stoul(manifest[thing].get<std::string>(), nullptr, 16) == matte_id(thing));
    }
    // Nothing else of the image has changed.
    REQUIRE(place.run({"ball.xml", "--aov", "depth", "-o", "b.exr"}).code == 0);
    const ImageFile plain = read_image(place.path("b.exr"));
    for (size_t i = 0; i < size_t(plain.image.width) * size_t(plain.image.height); ++i)
      for (const std::string& name : plain.image.channels)
        CHECK(plain.image
                  .data[i * plain.image.channels.size() + size_t(plain.image.find_channel(name))] ==
              file.image
                  .data[i * file.image.channels.size() + size_t(file.image.find_channel(name))]);
    CHECK(field(plain, "/name").empty());
  }

  TEST_CASE("mattes keep their names and have parts of their own") {
    const Workplace place;
    place.scene("ball.xml", scene_with_ball());
    for (const std::string names : {"blender", "nuke", "mitsuba"}) {
      CAPTURE(names);
      REQUIRE(
          place
              .run({"ball.xml", "--cryptomatte", "object", "--aov-names", names, "-o", "named.exr"})
              .code == 0);
      check_ids(read_image(place.path("named.exr")).image, MatteKind::object, {"shape#0", "ball"});
    }
    REQUIRE(
        place.run({"ball.xml", "--cryptomatte", "object", "--exr-parts", "-o", "parts.exr"}).code ==
        0);
    const ImageFile parts = read_image(place.path("parts.exr"));
    const bool has_part = parts.image.find_channel("CryptoObject01.CryptoObject01.R") >= 0 ||
                          parts.image.find_channel("CryptoObject01.R") >= 0;
    CHECK(has_part);
    CHECK(field(parts, "/name") == "CryptoObject");
  }

  TEST_CASE("mattes are skipped, made again, and left out as other layers are") {
    const Workplace place;
    place.scene("ball.xml", scene_with_ball());
    const std::vector<std::string> call{"ball.xml", "--cryptomatte", "object", "-x", "-o", "a.exr"};
    REQUIRE(place.run(call).code == 0);
    CHECK(contains(place.run(call).err, "skipped"));
    CHECK(contains(place.run({"ball.xml", "-x", "-o", "a.exr"}).err, "is rendered again"));
    // Beside an EXR file, one for display has the colours only.
    REQUIRE(place.run({"ball.xml", "--cryptomatte", "object", "-o", "c.exr", "-o", "c.png"}).code ==
            0);
    CHECK(read_image(place.path("c.png")).image.channels.size() <= 4);
  }

  TEST_CASE("lights that the method hides are hidden in mattes, however it is told to") {
    const Workplace place;
    TinyScene s = scene_with_ball();
    s.extra += R"(<shape type="rectangle" id="lamp"><transform name="to_world">
      <translate z="1"/></transform><emitter type="area"/></shape>)";
    place.scene("lamp.xml", s);
    REQUIRE(place.run({"lamp.xml", "--cryptomatte", "object", "-o", "seen.exr"}).code == 0);
    check_ids(read_image(place.path("seen.exr")).image, MatteKind::object,
              {"shape#0", "ball", "lamp"});
    const Image seen = read_image(place.path("seen.exr")).image;
    const int first = seen.find_channel("CryptoObject00.R");
    CHECK(std::bit_cast<uint32_t>(seen.pixel(8, 6)[first]) == matte_id("lamp"));
    for (const std::string method : {"path", "auto"}) {
      CAPTURE(method);
      REQUIRE(place
                  .run({"lamp.xml", "--cryptomatte", "object", "-i", method, "-I",
                        "hide_emitters=true", "-o", "hidden.exr"})
                  .code == 0);
      check_ids(read_image(place.path("hidden.exr")).image, MatteKind::object, {"shape#0", "ball"});
    }
  }

  TEST_CASE("mattes have as many samples as the image, however it ends") {
    const Workplace place;
    place.scene("ball.xml", scene_with_ball());
    for (const std::vector<std::string>& ending :
         std::vector<std::vector<std::string>>{{"--target-error", "20%"}, {"--time", "0.2s"}}) {
      std::vector<std::string> call{"ball.xml", "--cryptomatte", "object", "-o", "a.exr"};
      call.insert(call.end(), ending.begin(), ending.end());
      REQUIRE(place.run(call).code == 0);
      const Image image = read_image(place.path("a.exr")).image;
      const int first = image.find_channel("CryptoObject00.R");
      for (int x = 0; x < image.width; ++x) {
        const float* p = image.pixel(x, 6) + first;
        CHECK(p[1] + p[3] == doctest::Approx(1));
      }
    }
  }

  TEST_CASE("mattes are refused where there is no place for them") {
    const Workplace place;
    place.scene("ball.xml", scene_with_ball());
    const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
      arguments.insert(arguments.begin(), {"ball.xml", "--cryptomatte", "object"});
      const Outcome o = place.run(arguments);
      CAPTURE(o.err);
      CHECK(o.code == 2);
      CHECK(contains(o.err, why));
    };
    refused({"-o", "a.png"}, "only .exr files can hold the other layers");
    refused({"--raw", "a.raw.exr"}, "raw films hold no mattes");
    refused({"--raw", "a.raw.exr", "-o", "a.exr", "--slice", "1/2"}, "cannot be put together");
    refused({"--cryptomatte", "asset"}, "asset");
    CHECK(place.count() == 1);
  }
}
