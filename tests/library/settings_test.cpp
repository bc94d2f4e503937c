// What the library says of numbers that make no sense.
#include <doctest/doctest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <string>

#include "app/workplace.h"
#include "duet/duet.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kMost = std::numeric_limits<int>::max();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A change of settings, and what the message has.
struct WrongSetting {
  std::function<void(RenderSettings&)> change;
  std::string text;
};

/// What is thrown, "" for nothing; `Expected` is its type.
template <class Expected>
std::string thrown(const std::function<void()>& call) {
  try {
    call();
  } catch (const Expected& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the library's settings of renders: what makes no sense") {
    const Workplace place;
    const SceneFile scene = SceneFile::load(place.scene());
    const std::vector<WrongSetting> all = {
        {[](auto& s) { s.spp = 0; }, "0 samples per pixel"},
        {[](auto& s) { s.spp = -4; }, "-4 samples per pixel"},
        {[](auto& s) { s.spp = kMost; }, "from 1 to 1073741824"},
        {[](auto& s) { s.seconds = 0; }, "0 seconds"},
        {[](auto& s) { s.seconds = -1; }, "-1 seconds"},
        {[](auto& s) { s.seconds = kNotANumber; }, "nan seconds"},
        {[](auto& s) { s.seconds = kInfinite; }, "inf seconds"},
        {[](auto& s) { s.target_error = 0; }, "target_error: 0 is not"},
        {[](auto& s) { s.target_error = kNotANumber; }, "target_error: nan is not"},
        {[](auto& s) { s.target_error = kInfinite; }, "target_error: inf is not"},
        {[](auto& s) {
           s.size = {{0, 8}};
         },
         "size: 0 × 8"},
        {[](auto& s) {
           s.size = {{8, -8}};
         },
         "size: 8 × -8"},
        {[](auto& s) {
           s.size = {{65537, 1}};
         },
         "65536 × 65536"},
        {[](auto& s) {
           s.crop = {{-1, 0, 4, 4}};
         },
         "crop: a window of 4 × 4 pixels from (-1, 0)"},
        {[](auto& s) {
           s.crop = {{0, 0, 0, 4}};
         },
         "crop: a window of 0 × 4"},
        {[](auto& s) {
           s.crop = {{4, 4, -2, -2}};
         },
         "crop: a window of -2 × -2"},
        {[](auto& s) { s.threads = -5; }, "threads: -5 is not"},
        {[](auto& s) { s.threads = kMost; }, "threads: 2147483647 is not"}};
    for (const WrongSetting& wrong : all) {
      CAPTURE(wrong.text);
      RenderSettings settings;
      wrong.change(settings);
      const std::string text = thrown<std::invalid_argument>([&] { render_file(scene, settings); });
      CHECK_MESSAGE(contains(text, wrong.text), text);
    }
    RenderWatch watch;
    watch.image_seconds = kNotANumber;
    CHECK_THROWS_AS(render_file(scene, {}, watch), std::invalid_argument);
  }

  TEST_CASE("the library's windows that reach beyond the film, however far") {
    const Workplace place;
    const SceneFile scene = SceneFile::load(place.scene());
    for (const std::array<int, 4> window :
         {std::array{8, 8, 9, 1}, {kMost, 0, kMost, 3}, {0, 1, 1, kMost}, {16, 0, 1, 1}}) {
      CAPTURE(window[0]);
      RenderSettings settings;
      settings.crop = window;
      CHECK_THROWS_AS(render_file(scene, settings), std::out_of_range);
    }
    RenderSettings last;
    last.spp = 1;
    last.crop = {{15, 11, 1, 1}};
    CHECK(render_file(scene, last)->width() == 1);
  }

  TEST_CASE("the library's progress: the last one is of the end") {
    const Workplace place;
    std::vector<RenderedShare> told;
    std::atomic<bool> cancel{false};
    RenderWatch watch;
    watch.progress = [&](const RenderedShare& share) { told.push_back(share); };
    watch.cancel = &cancel;
    const SceneFile scene = SceneFile::load(place.scene());
    CHECK(render_file(scene, {}, watch).has_value());
    REQUIRE(!told.empty());
    CHECK(told.back().fraction == 1);
    CHECK(told.back().spp == 4);
    CHECK(told.back().seconds > 0);
    watch.progress = [&](const RenderedShare& share) {
      told.push_back(share);
      if (share.spp >= 1) cancel = true;
    };
    RenderSettings endless;
    endless.spp = 1 << 30;
    CHECK(render_file(SceneFile::load(place.scene("endless.xml", endless_scene())), endless, watch)
              ->interrupted());
    CHECK(told.back().fraction < 1);
  }

  TEST_CASE("the library's paths have no zero bytes, which would end them") {
    const Workplace place;
    place.scene();
    const std::string cut = place.path("tiny.xml") + std::string("\0.exr", 5);
    const RenderedImage image = RenderedImage::from_rgba(std::vector<float>(4), 1, 1);
    CHECK_THROWS_AS(image.save(cut), std::invalid_argument);
    CHECK_THROWS_AS(SceneFile::load(cut), std::invalid_argument);
    CHECK_THROWS_AS(SceneFile::from_text("<scene/>", {{}, {cut}}), std::invalid_argument);
    CHECK_THROWS_AS(ComparedImage::load(cut), std::invalid_argument);
    CHECK_THROWS_AS(merge_films({cut}), std::invalid_argument);
    CHECK(place.count() == 1);
  }

  TEST_CASE("the library's exposures and comparisons: what makes no sense") {
    const std::vector<float> values(4, 0.5f);
    const RenderedImage image = RenderedImage::from_rgba(values, 1, 1);
    for (const double exposure : {kNotANumber, kInfinite, 1e9, -100.5})
      CHECK_THROWS_AS(image.png({exposure, false, "", 8}), std::invalid_argument);
    CHECK(!image.png({-100, false, "", 8}).empty());
    const ComparedImage compared = ComparedImage::from_image(image);
    for (const double spp : {0.0, -1.0, kNotANumber, kInfinite}) {
      CHECK_THROWS_AS(compare_images(compared, compared, ReferenceVariance{compared, spp, 1}),
                      std::invalid_argument);
      CHECK_THROWS_AS(compare_images(compared, compared, ReferenceVariance{compared, 1, spp}),
                      std::invalid_argument);
    }
    const std::vector<float> less(4, -0.5f);
    const ComparedImage negative = ComparedImage::from_pixels(less, 1, 1, {"R", "G", "B", "A"});
    CHECK_THROWS_WITH_AS(compare_images(compared, compared, ReferenceVariance{negative, 1, 1}),
                         "the variance is negative: it is no variance", std::invalid_argument);
    CHECK_THROWS_AS(compare_images(compared, compared, {}, -1), std::invalid_argument);
  }

  TEST_CASE("the library's errors of scenes that have no error") {
    CHECK(SceneError({}).first().text.empty());
    const SceneError warned({{false, "", 0, 0, "a warning"}});
    CHECK(warned.first().text.empty());
    CHECK(std::string(warned.what()).empty());
    CHECK(SceneError({{false, "", 0, 0, "a"}, {true, "", 1, 2, "b"}}).first().text == "b");
  }
}
