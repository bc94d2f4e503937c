#include "evaluate/compare/compare.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "evaluate/compare/json.h"
#include "evaluate/compare/text.h"
#include "image/image_io.h"
#include "support/files.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Directories a and b with images of 16 × 16 values around 1.
struct Images : TemporaryDirectory {
  Images() {
    for (const char* d : {"a", "b"}) std::filesystem::create_directory(path(d));
  }
  /// `spp` stands in the header unless it is 0, and `seed` unless it is empty.
  std::string image(const std::string& name, float deviation, int spp = 0,
                    const std::string& seed = "") const {
    Image image(16, 16, {"R", "G", "B"});
    for (size_t i = 0; i < image.data.size(); ++i)
      image.data[i] = 1 + (i % 2 == 0 ? deviation : -deviation);
    ExrOptions options;
    options.half = false;
    if (spp > 0) options.header.emplace_back("spp", spp);
    if (!seed.empty()) options.header.emplace_back("seed", seed);
    write_exr(path(name), image, options);
    return path(name);
  }
};

}  // namespace

TEST_CASE("a comparison is data: figures, what they miss, and nothing else") {
  const Images files;
  CompareSettings s;
  s.image = files.image("a/one.exr", 0.2f);
  s.reference = files.image("b/one.exr", 0);
  s.requirements = {{"rmse<0.1", "rmse", true, 0.1}, {"rmse<0.3", "rmse", true, 0.3}};
  const Comparison c = compare_pair(s);
  CHECK(c.compared());
  CHECK(c.measurements.metrics.rmse == doctest::Approx(0.2));
  REQUIRE(c.missed.size() == 1);
  CHECK(c.missed[0].text == "rmse<0.1");
  CHECK(!c.met(s));
  CHECK(c.verdict == Verdict::noisy);
  CHECK(c.images.empty());
  // The same in all forms.
  CHECK(comparison_json(s, c)["rmse"].get<double>() == c.measurements.metrics.rmse);
  CHECK(comparison_json(s, c)["missed"] == nlohmann::ordered_json{"rmse<0.1"});
  CHECK(comparison_text(c).find("missed     rmse<0.1\n") != std::string::npos);
  CHECK(junit_report(s, {c}).find("failures=\"1\"") != std::string::npos);

  s.for_page = true;
  const Comparison shown = compare_pair(s);
  CHECK(shown.images.size() == 2);
  const std::string page = compare_page(s, {shown}, "the <command> that made it");
  CHECK(page.find("the &lt;command&gt; that made it") != std::string::npos);
}

TEST_CASE("without the numbers of samples there is no test for bias") {
  const Images files;
  CompareSettings s;
  s.image = files.image("a/one.exr", 0.2f);
  s.reference = files.image("b/one.exr", 0, 1024);
  s.variance = files.image("variance.exr", 0);
  try {
    compare_pair(s);
    FAIL("nobody says how many samples the image has");
  } catch (const UnknownSamples& e) {
    CHECK(e.of() == UnknownSamples::Of::image);
    CHECK(e.path() == s.image);
  }
  s.spp = 16;
  CHECK(compare_pair(s).tells_noise);
}

TEST_CASE("of two directories every name is passed on, in order") {
  const Images files;
  for (const char* name : {"a/both.exr", "b/both.exr", "a/new.exr", "b/old.exr"})
    files.image(name, 0);
  files.write("a/bad.exr", "no image");
  files.image("b/bad.exr", 0);
  CompareSettings s;
  s.image = files.path("a"), s.reference = files.path("b");
  std::vector<std::string> names;
  const auto all =
      compare_directories(s, [&](const Comparison& c) { names.push_back(c.name + c.only_in); });
  CHECK(names ==
        std::vector<std::string>{"bad.exr", "both.exr", "new.exrimage", "old.exrreference"});
  REQUIRE(all.size() == 4);
  CHECK(!all[0].failure.empty());
  CHECK(all[1].compared());
  CHECK(all[3].met(s));
  s.require_complete = true;
  CHECK(!all[3].met(s));
  CHECK(comparisons_json(s, all)[0]["name"] == "bad.exr");
  CHECK(table_text(s, all).ends_with(summary_of(s, all) + "\n"));
}

TEST_CASE("sets of images are told apart by their spread") {
  const Images files;
  std::vector<std::string> a, b;
  for (int i = 0; i < 8; ++i) {
    a.push_back(files.image(fmt::format("a/{}.exr", i), 0.01f * float(i)));
    b.push_back(files.image(fmt::format("b/{}.exr", i), 0.01f * float(7 - i)));
  }
  CompareSettings s;
  s.image = "a", s.reference = "b";
  const Comparison c = compare_sets(s, a, b);
  REQUIRE(c.measurements.tiles);
  CHECK(c.tells_noise);
  CHECK(c.measurements.tiles->equal());
}

TEST_CASE("images of a set that are not independent are no set") {
  const Images files;
  const std::vector<std::string> other{files.image("b/0.exr", 0.3f), files.image("b/1.exr", 0.4f)};
  CompareSettings s;
  s.image = "a", s.reference = "b";
  const auto set = [&](std::pair<float, const char*> one, std::pair<float, const char*> two) {
    return std::vector{files.image("a/0.exr", one.first, 0, one.second),
                       files.image("a/1.exr", two.first, 0, two.second)};
  };
  // The same pixels: no spread, unless seeds say that this is all the noise there is.
  const auto copies = set({0.1f, "7"}, {0.1f, "7"});
  CHECK_THROWS_WITH(compare_sets(s, copies, other),
                    doctest::Contains("a/1.exr has the same pixels as "));
  CHECK_THROWS_WITH(compare_sets(s, other, copies),
                    doctest::Contains("render each with another seed (--seed)"));
  for (const auto& [one, two] : {std::pair{"", ""}, {"7", ""}, {"", "7"}}) {
    SHOW(one);
    SHOW(two);
    CHECK(compare_sets(s, set({0.1f, one}, {0.1f, two}), other)
              .warning.find("a/1.exr has the same pixels as ") != std::string::npos);
  }
  CHECK(compare_sets(s, set({0.1f, "7"}, {0.1f, "8"}), other).warning.empty());
  // The same seed: perhaps noise in common.
  const std::string warning = compare_sets(s, set({0.1f, "7"}, {0.2f, "7"}), other).warning;
  CAPTURE(warning);
  CHECK(warning.find("a/1.exr has the seed of ") != std::string::npos);
  CHECK(comparison_json(s, compare_sets(s, other, set({0.1f, "7"}, {0.2f, "7"})))["warning"]
            .get<std::string>()
            .find("a/0.exr, 7: ") != std::string::npos);
  CHECK(compare_sets(s, set({0.1f, "7"}, {0.2f, "8"}), other).warning.empty());
  CHECK(compare_sets(s, set({0.1f, ""}, {0.2f, ""}), other).warning.empty());
  // An image on both sides agrees with itself.
  CHECK(compare_sets(s, other, other).warning.find("have the same pixels") != std::string::npos);
}
