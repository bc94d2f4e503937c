// The library's mattes and its denoised images: those of the program, and what is said where there
// are none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "app/workplace.h"
#include "duet/duet.h"
#include "image/image_io.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr const char* kVariable = "DUET_OIDN_LIBRARY";
/// Makes what stands in for the denoiser fail.
constexpr const char* kFailure = "DUET_FAKE_OIDN";

SceneFile tiny_scene(const Workplace& place) {
  TinyScene scene = exact_scene();
  scene.extra = R"(<shape type="sphere" id="ball"><float name="radius" value="0.5"/>
    <bsdf type="diffuse" id="paint"/></shape>)";
  return SceneFile::load(place.scene("tiny.xml", scene));
}

RenderSettings settings_with(int spp, bool denoise) {
  RenderSettings settings;
  settings.spp = spp;
  settings.denoise = denoise;
  return settings;
}

std::string field(const RenderedImage& image, const std::string& name) {
  for (const auto& [key, value] : image.metadata())
    if (key == name) return std::get<std::string>(value);
  return "";
}

bool same_pixels(const RenderedImage& a, const RenderedImage& b) {
  return a.channels() == b.channels() &&
         std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin(), b.pixels().end());
}

/// Of the pixel i.
float value(const RenderedImage& image, size_t i, const std::string& channel) {
  const auto& names = image.channels();
  const auto at = std::find(names.begin(), names.end(), channel);
  REQUIRE(at != names.end());
  return image.pixels()[i * names.size() + size_t(at - names.begin())];
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the library's mattes are those of the program, and saved as its are") {
    const Workplace place;
    const SceneFile scene = tiny_scene(place);
    RenderSettings settings = settings_with(4, false);
    settings.layers = {"depth"};
    settings.cryptomatte = {"material", "object", "material"};
    const RenderedImage image = render_file(scene, settings).value();
    image.save(place.path("own.exr"));
    REQUIRE(place
                .run({"tiny.xml", "--aov", "depth", "--cryptomatte", "object,material", "-o",
                      "program.exr"})
                .code == 0);
    const ImageFile own = read_image(place.path("own.exr")),
                    program = read_image(place.path("program.exr"));
    CHECK(own.image.channels == program.image.channels);
    CHECK(own.image.channels.size() == 3 + 1 + 24);
    CHECK(own.image.data == program.image.data);
    const auto mattes = [](const ImageFile& file) {
      std::vector<std::pair<std::string, std::string>> fields;
      for (const auto& [name, text] : file.header)
        if (name.starts_with("cryptomatte/")) fields.emplace_back(name, text);
      return fields;
    };
    CHECK(mattes(own).size() == 8);
    CHECK(mattes(own) == mattes(program));
    settings.cryptomatte = {"asset"};
    CHECK_THROWS_WITH_AS(render_file(scene, settings),
                         "there are no mattes of \"asset\"; there are object material",
                         std::invalid_argument);
  }
}

// In a process of its own (tests/CMakeLists.txt): a denoiser that has been loaded stays, and so
// does the environment.
TEST_CASE("the library's memory: that of mattes counts" * doctest::skip()) {
  const Workplace place;
  const SceneFile scene = tiny_scene(place);
  setenv("DUET_MEMORY_LIMIT", "1", 1);
  /// The gigabytes that the refusal speaks of.
  const auto needed = [&](const std::vector<std::string>& mattes) {
    RenderSettings settings = settings_with(1, false);
    settings.size = {{4000, 4000}};
    settings.cryptomatte = mattes;
    try {
      render_file(scene, settings);
    } catch (const MemoryError& e) {
      const std::string text = e.what(), before = "needs about ";
      REQUIRE(contains(text, before));
      return std::stod(text.substr(text.find(before) + before.size()));
    }
    return 0.0;
  };
  const double none = needed({}), one = needed({"object"}), both = needed({"object", "material"});
  CHECK(none > 0.1);
  // Four copies of 12 channels, and more.
  CHECK(one > none + 4 * 12 * 4 * 16e6 / 1e9);
  CHECK(both > one + 4 * 12 * 4 * 16e6 / 1e9);
  unsetenv("DUET_MEMORY_LIMIT");
}

TEST_CASE("the library's denoiser: missing, failing, and what stands in for one" *
          doctest::skip()) {
  const Workplace place;
  const SceneFile scene = tiny_scene(place);
  const RenderedImage plain = render_file(scene, settings_with(1, false)).value();
  CHECK(!plain.denoised());

  setenv(kVariable, "/does/not/exist.so", 1);
  CHECK_THROWS_WITH_AS(render_file(scene, settings_with(1, true)),
                       "Open Image Denoise cannot be loaded: /does/not/exist.so "
                       "(DUET_OIDN_LIBRARY) does not exist",
                       DenoiserError);
  setenv(kVariable, DUET_FAKE_OIDN, 1);
  setenv(kFailure, "device", 1);
  CHECK_THROWS_AS(render_file(scene, settings_with(1, true)), DenoiserError);
  setenv(kFailure, "filter", 1);
  const RenderedImage kept = render_file(scene, settings_with(1, true)).value();
  CHECK(same_pixels(kept, plain));
  CHECK_THROWS_WITH_AS(kept.denoised(), "Open Image Denoise: out of memory", DenoiserError);
  unsetenv(kFailure);
  RenderSettings layers_only = settings_with(1, true);
  layers_only.integrator = "aov";
  layers_only.layers = {"depth"};
  CHECK_THROWS_WITH_AS(render_file(scene, layers_only),
                       "the image has layers only, no colours to denoise", std::invalid_argument);

  RenderSettings settings = settings_with(1, true);
  settings.cryptomatte = {"object"};
  settings.layers = {"denoise_albedo", "denoise_normal"};
  const RenderedImage noisy = render_file(scene, settings).value();
  const RenderedImage clean = noisy.denoised().value();
  CHECK(clean.channels() == std::vector<std::string>{"R", "G", "B", "A"});
  REQUIRE(plain.channels() == clean.channels());
  CHECK(noisy.channels().size() == 4 + 6 + 12);  // denoise_split was for the denoiser alone
  CHECK(!clean.denoised());
  for (size_t i = 0; i < plain.pixels().size() / 4; ++i) {
    CHECK(value(clean, i, "A") == value(plain, i, "A"));
    for (const std::string c : {"R", "G", "B"}) {
      CHECK(value(noisy, i, c) == value(plain, i, c));
      const std::string axis(1, char('X' + std::string("RGB").find(c)));
      CHECK(value(clean, i, c) ==
            doctest::Approx(value(noisy, i, c) + 10 * value(noisy, i, "denoise_albedo." + c) +
                            100 * value(noisy, i, "denoise_normal." + axis))
                .epsilon(1e-5));
    }
  }
  CHECK(field(clean, "denoiser") == "Open Image Denoise 2.99.7");
  CHECK(contains(field(clean, "bias"), "denoised by Open Image Denoise"));
  CHECK(field(noisy, "denoiser").empty());
  CHECK(field(noisy, "bias").empty());

  // Images on the way have no layers of the denoiser.
  RenderWatch watch;
  size_t images = 0;
  watch.image_seconds = 0;
  watch.image_so_far = [&](const RenderedImage& so_far) {
    ++images;
    CHECK(so_far.channels() == plain.channels());
    CHECK(!so_far.denoised());
  };
  CHECK(render_file(scene, settings_with(256, true), watch)->denoised());
  CHECK(images > 0);
}
