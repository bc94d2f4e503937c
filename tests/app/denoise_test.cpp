// --denoise: what is written and said, by a library that stands in for Open Image Denoise, and
// libraries that are none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "app/workplace.h"
#include "image/image_facts.h"
#include "image/image_io.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr const char* kVariable = "DUET_OIDN_LIBRARY";

class DenoisingWorkplace : public Workplace {
 public:
  Outcome denoise(const std::vector<std::string>& arguments,
                  std::vector<std::pair<std::string, std::string>> environment = {}) const {
    environment.emplace_back(kVariable, DUET_FAKE_OIDN);
    return run_duet(arguments, {.directory = path(""), .environment = environment});
  }
  Image image(const std::string& name) const { return read_image(path(name)).image; }
  ImageFacts facts(const std::string& name) const { return read_image_facts(path(name)); }
};

std::vector<float> channel(const Image& image, const std::string& name) {
  const int c = image.find_channel(name);
  REQUIRE(c >= 0);
  std::vector<float> values;
  for (size_t i = size_t(c); i < image.data.size(); i += image.channels.size())
    values.push_back(image.data[i]);
  return values;
}

/// A mirror before the square, of which the left half of the image sees nothing else.
TinyScene scene_with_mirror() {
  TinyScene s = exact_scene();
  s.extra = R"(<shape type="rectangle"><transform name="to_world"><scale value="0.3"/>
    <rotate y="1" angle="30"/><translate x="-0.6" z="1"/></transform>
    <bsdf type="conductor"><string name="material" value="none"/></bsdf></shape>)";
  return s;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the denoiser gets colours, albedo and normals; the image itself keeps its bits") {
    const DenoisingWorkplace place;
    place.scene("tiny.xml", scene_with_mirror());
    REQUIRE(place.run({"tiny.xml", "--spp", "1", "-o", "plain.exr"}).code == 0);
    const Outcome o = place.denoise({"tiny.xml", "--spp", "1", "-o", "a.exr", "--denoise"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "-> a.exr -> a.denoised.exr"));
    CHECK(place.image("a.exr").channels == place.image("plain.exr").channels);
    CHECK(place.image("a.exr").data == place.image("plain.exr").data);
    // What the denoiser makes of it says what it got.
    REQUIRE(place
                .denoise({"tiny.xml", "--spp", "1", "-o", "b.exr", "--denoise", "--aov",
                          "denoise_albedo,denoise_normal"})
                .code == 0);
    const Image noisy = place.image("b.exr"), clean = place.image("a.denoised.exr");
    CHECK(clean.data == place.image("b.denoised.exr").data);
    CHECK(clean.channels == std::vector<std::string>{"R", "G", "B"});
    const std::string axes[] = {"X", "Y", "Z"};
    for (size_t c = 0; c < 3; ++c) {
      const std::string colour = clean.channels[c];
      const std::vector<float> r = channel(noisy, colour),
                               albedo = channel(noisy, "denoise_albedo." + colour),
                               normal = channel(noisy, "denoise_normal." + axes[c]),
                               out = channel(clean, colour);
      for (size_t i = 0; i < r.size(); ++i)
        CHECK(out[i] == doctest::Approx(r[i] + 10 * albedo[i] + 100 * normal[i]).epsilon(1e-5));
    }
  }

  TEST_CASE("mattes are part of the image, and not of the denoised one") {
    const DenoisingWorkplace place;
    place.scene("tiny.xml");
    REQUIRE(place.denoise({"tiny.xml", "--denoise", "-o", "a.exr"}).code == 0);
    REQUIRE(
        place.denoise({"tiny.xml", "--denoise", "--cryptomatte", "object", "-o", "b.exr"}).code ==
        0);
    const Image image = place.image("b.exr");
    CHECK(image.channels.size() == 3 + 12);
    CHECK(image.find_channel("CryptoObject00.R") == 3);
    const Image clean = place.image("b.denoised.exr");
    CHECK(clean.channels == place.image("a.denoised.exr").channels);
    CHECK(clean.data == place.image("a.denoised.exr").data);
    const auto fields = [&](const std::string& name) {
      const auto header = read_image(place.path(name)).header;
      return std::count_if(header.begin(), header.end(), [](const auto& field) {
        return field.first.starts_with("cryptomatte/");
      });
    };
    CHECK(fields("b.exr") == 4);
    CHECK(fields("b.denoised.exr") == 0);
  }

  TEST_CASE("where noise does not explain what the denoiser did, the image is as it was") {
    const DenoisingWorkplace place;
    TinyScene s = exact_scene();
    place.scene("tiny.xml", s);
    // What stands in for the denoiser adds about 100 to the third colour.
    const auto largest_change = [&](const std::string& method, const std::string& spp) {
      REQUIRE(place.denoise({"tiny.xml", "-i", method, "--spp", spp, "-o", "a.exr", "--denoise"})
                  .code == 0);
      const Image noisy = place.image("a.exr"), clean = place.image("a.denoised.exr");
      float most = 0;
      for (size_t i = 0; i < noisy.data.size(); ++i)
        most = std::max(most, std::abs(clean.data[i] - noisy.data[i]));
      return most;
    };
    CHECK(largest_change("path", "64") < 0.1f);
    CHECK(largest_change("path", "24") < 0.1f);
    // One sample has no two halves, and light sub-paths have other pixels.
    CHECK(largest_change("path", "1") > 90);
    CHECK(largest_change("bdpt", "64") > 90);
  }

  TEST_CASE("the denoised image says that it is biased, and compare takes it at its word") {
    const DenoisingWorkplace place;
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.denoise({"tiny.xml", "-o", "a.exr", "--denoise"}).code == 0);
    CHECK(place.facts("a.denoised.exr").field("denoiser") == "Open Image Denoise 2.99.7");
    CHECK(contains(place.facts("a.denoised.exr").field("bias"), "denoised"));
    CHECK(place.facts("a.exr").field("denoiser").empty());
    CHECK(place.facts("a.exr").field("bias").empty());
    const auto compare = [&](const std::string& image, const std::string& requirement) {
      return place.run(
          {"compare", image, "a.exr", "--variance", "a.exr", "--require", requirement});
    };
    CHECK(compare("a.exr", "bias<4").code != 1);
    for (const std::string figure : {"bias<4", "p>0.01", "z>0.5"}) {
      const Outcome o = compare("a.denoised.exr", figure);
      CHECK(o.code == 1);
      CHECK(contains(o.err, "was denoised by Open Image Denoise 2.99.7"));
    }
    const Outcome figures = compare("a.denoised.exr", "relrmse<1e9");
    CHECK(figures.code == 0);
    CHECK(contains(figures.err, "was denoised by Open Image Denoise 2.99.7 and is biased"));
    CHECK(!contains(compare("a.exr", "relrmse<1e9").err, "denoised"));
    const Outcome sets = place.run({"compare", "--batches", "a.denoised.exr,a.denoised.exr",
                                    "a.exr,a.exr", "--require", "tiles<1"});
    CHECK(sets.code == 1);
    CHECK(contains(sets.err, "was denoised"));
  }

  TEST_CASE("every file has its denoised one, and what exists is not rendered again") {
    const DenoisingWorkplace place;
    place.scene();
    const std::vector<std::string> command{"tiny.xml", "-o",        "out/", "-o",
                                           "a.png",    "--denoise", "-x"};
    CHECK(place.denoise(command).code == 0);
    for (const char* name : {"out/tiny.exr", "out/tiny.denoised.exr", "a.png", "a.denoised.png"})
      CHECK(place.has(name));
    CHECK(contains(place.facts("a.denoised.png").field("bias"), "denoised"));
    CHECK(contains(place.denoise(command).err, "skipped"));
    std::filesystem::remove(place.path("out/tiny.denoised.exr"));
    CHECK(!contains(place.denoise(command).err, "skipped"));
    CHECK(place.has("out/tiny.denoised.exr"));
    // The image is the same without --denoise.
    CHECK(contains(place.run({"tiny.xml", "-o", "out/", "-o", "a.png", "-x"}).err, "skipped"));
  }

  TEST_CASE("if the denoiser fails the image is there nevertheless") {
    const DenoisingWorkplace place;
    place.scene();
    const Outcome o = place.denoise({"tiny.xml", "--denoise"}, {{"DUET_FAKE_OIDN", "filter"}});
    CHECK(o.code == 1);
    CHECK(contains(o.err, "out of memory"));
    CHECK(place.has("tiny.exr"));
    CHECK(!place.has("tiny.denoised.exr"));
    const Outcome none =
        place.denoise({"tiny.xml", "-o", "b.exr", "--denoise"}, {{"DUET_FAKE_OIDN", "device"}});
    CHECK(none.code == 1);
    CHECK(contains(none.err, "no processor"));
    CHECK(!place.has("b.exr"));
  }

  TEST_CASE("a library that is missing, broken or another one is an error before rendering") {
    const Workplace place;
    place.scene();
    const std::string library = read_file(DUET_FAKE_OIDN);
    place.write("text.so", std::string(1000, 'x'));
    place.write("empty.so", "");
    place.write("cut.so", library.substr(0, library.size() / 2));
    const std::pair<std::string, std::string> broken[] = {
        {"missing.so", "does not exist"},
        {"text.so", "invalid ELF header"},
        {"empty.so", "file too short"},
        {"cut.so", "has been cut off"},
        {".", "cannot read file data"},
        {DUET_OTHER_LIBRARY, "is not its version 2"},
        {"", "does not exist"}};
    for (const auto& [name, reason] : broken) {
      SHOW(name);
      const Outcome o = run_duet({"tiny.xml", "--denoise"},
                                 {.directory = place.path(""), .environment = {{kVariable, name}}});
      CHECK(o.code == 1);
      CHECK(contains(o.err, "--denoise: Open Image Denoise cannot be loaded"));
      CHECK(contains(o.err, reason));
      CHECK(!place.has("tiny.exr"));
    }
  }

  TEST_CASE("what cannot be denoised is wrong usage") {
    const DenoisingWorkplace place;
    place.scene();
    const std::vector<std::string> wrong[] = {
        {"-i", "aov", "--aov", "depth"}, {"-o", "-"}, {"--raw", "raw.exr"}};
    for (std::vector<std::string> arguments : wrong) {
      CAPTURE(arguments[0]);
      arguments.insert(arguments.begin(), {"tiny.xml", "--denoise"});
      const Outcome o = place.denoise(arguments);
      CHECK(o.code == 2);
      CHECK(contains(o.err, "--denoise"));
    }
  }
}
