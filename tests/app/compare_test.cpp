// duet compare: figures, verdicts and exit codes.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

#include "app/workplace.h"
#include "image/image_io.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A grey image of 1 with noise of this deviation, plus `shift`.
void write_noise(const std::string& path, double deviation, double shift, unsigned seed, int size,
                 int spp = 0) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> noise(float(1 + shift), float(deviation));
  Image image(size, size, {"R", "G", "B"});
  for (float& v : image.data) v = deviation > 0 ? noise(generator) : float(1 + shift);
  ExrOptions options;
  options.half = false;
  if (spp > 0) options.header.emplace_back("spp", spp);
  write_exr(path, image, options);
}

/// Images of 16 samples with variance 0.64 each, so with a deviation of 0.2, and their reference.
struct Gallery : Workplace {
  Gallery() {
    write_noise(path("good.exr"), 0.2, 0, 1, 64, 16);
    write_noise(path("shifted.exr"), 0.2, 0.05, 2, 64, 16);
    write_noise(path("reference.exr"), 0.002, 0, 3, 64, 160000);
    write_noise(path("variance.exr"), 0, 0.64 - 1, 4, 64);
    write_noise(path("small.exr"), 0.2, 0, 5, 32);
    Image holes = read_image(path("good.exr")).image;
    holes.data[30] = NAN;
    ExrOptions options;
    options.half = false;
    write_exr(path("nan.exr"), holes, options);
  }
  Outcome compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run(arguments);
  }
};

std::string verdict(const Outcome& o) {
  const size_t at = o.out.find("verdict    ");
  if (at == std::string::npos) return "";
  return o.out.substr(at + 11, o.out.find_first_of(" \n", at + 11) - at - 11);
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("verdicts and exit codes of compare") {
    const Gallery g;
    const Outcome plain = g.compare({"good.exr", "reference.exr"});
    CHECK(plain.code == 0);
    // Without a threshold there is nothing to pass.
    CHECK(contains(plain.out, "verdict    no threshold given: relrmse 0.2"));
    CHECK(contains(plain.out, "without --variance"));
    CHECK(contains(plain.out, "bias       not available"));
    CHECK(contains(plain.out, "p          not available"));
    const std::vector<std::string> v{"--variance", "variance.exr"};
    const auto with = [&](std::vector<std::string> a, const std::vector<std::string>& more) {
      a.insert(a.end(), more.begin(), more.end());
      return a;
    };
    const Outcome good = g.compare(with({"good.exr", "reference.exr", "--require", "rmse<0.25",
                                         "--require", "bias<4", "--require", "z>0.9975"},
                                        v));
    CHECK(good.code == 0);
    CHECK(verdict(good) == "PASS");
    const Outcome noisy =
        g.compare(with({"good.exr", "reference.exr", "--require", "rmse<0.1"}, v));
    CHECK(noisy.code == 3);
    CHECK(verdict(noisy) == "NOISY");
    CHECK(contains(noisy.out, "missed     rmse<0.1"));
    const Outcome biased = g.compare(with({"shifted.exr", "reference.exr"}, v));
    CHECK(biased.code == 0);
    CHECK(verdict(biased) == "BIASED");
    CHECK(contains(biased.out, "different beyond noise, p "));
    const Outcome known = g.compare(with({"good.exr", "reference.exr"}, v));
    CHECK(contains(known.out, "verdict    no threshold given: no bias found, p "));
    CHECK(contains(known.out, "(95 %)"));
    // A figure whose rate of false alarms nobody knows does not make the verdict BIASED.
    const Outcome tails =
        g.compare(with({"good.exr", "reference.exr", "--require", "zrms<0.5"}, v));
    CHECK(tails.code == 3);
    CHECK(verdict(tails) == "NOISY");
    CHECK(g.compare(with({"good.exr", "reference.exr", "--require", "p>0.01"}, v)).code == 0);
    CHECK(g.compare(with({"shifted.exr", "reference.exr", "--require", "p>0.01"}, v)).code == 3);
    const Outcome missed =
        g.compare(with({"--require", "bias<4", "shifted.exr", "reference.exr"}, v));
    CHECK(missed.code == 3);
    CHECK(verdict(missed) == "BIASED");
    const Outcome unclear = g.compare({"shifted.exr", "reference.exr", "--require", "rmse<0.1"});
    CHECK(unclear.code == 3);
    CHECK(contains(unclear.out, "only --variance can tell"));
    const Outcome holes = g.compare({"nan.exr", "reference.exr"});
    CHECK(holes.code == 0);
    CHECK(verdict(holes) == "FAIL");
    // NaN never passes, whatever is required.
    CHECK(g.compare({"nan.exr", "reference.exr", "--require", "rmse<9"}).code == 3);
    CHECK(g.compare({"good.exr", "nan.exr"}).code == 1);
  }

  TEST_CASE("the samples of variances come from the options or the headers") {
    const Gallery g;
    // The same deviation from a hundredth of the samples is nothing to wonder about.
    const auto passes = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), {"--require", "p>0.01"});
      return g.compare(arguments).code == 0;
    };
    CHECK(passes({"good.exr", "reference.exr", "--variance", "variance.exr"}));
    // A hundred times the samples explain a tenth of this noise. It is no bias: the light is right.
    const std::vector<std::string> more{"reference.exr", "--variance", "variance.exr", "--spp",
                                        "1600"};
    const auto with_more = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), more.begin(), more.end());
      return g.compare(arguments);
    };
    const auto calm = nlohmann::json::parse(with_more({"--json", "good.exr"}).out);
    CHECK(double(calm["zrms"]) == doctest::Approx(10).epsilon(0.05));
    CHECK(double(calm["z"]) < 0.9975);
    CHECK(calm["verdict"] == "no threshold given");
    CHECK(contains(calm["known"], "the noise is 10 times"));
    CHECK(verdict(with_more({"shifted.exr"})) == "BIASED");
    // Where the variance is the largest number of a half, it is not known.
    write_noise(g.path("unknown.exr"), 0, 65504 - 1, 6, 64);
    const std::vector<std::string> unknown{"shifted.exr", "reference.exr", "--variance",
                                           "unknown.exr"};
    CHECK(contains(g.compare(unknown).out, "no pixel has a known variance"));
    CHECK_FALSE(passes(unknown));
    CHECK(passes(
        {"shifted.exr", "reference.exr", "--variance", "variance.exr", "--reference-spp", "0.01"}));
    const Outcome o =
        g.compare({"small.exr", "small.exr", "--variance", "small.exr", "--reference-spp", "1"});
    CHECK(o.code == 2);
    CHECK(contains(o.err, "--spp"));
  }

  TEST_CASE("figures as JSON") {
    const Gallery g;
    const Outcome o = g.compare({"good.exr", "reference.exr", "--json", "--require", "mae<0.01"});
    CHECK(o.code == 3);
    const auto j = nlohmann::json::parse(o.out);
    CHECK(double(j["rmse"]) == doctest::Approx(0.2).epsilon(0.05));
    CHECK(double(j["relrmse"]) == doctest::Approx(0.2).epsilon(0.05));
    CHECK(double(j["relmse"]) == doctest::Approx(0.04 / 1.01).epsilon(0.1));
    CHECK(double(j["trimmed"]) < double(j["relmse"]));
    CHECK(double(j["mae"]) == doctest::Approx(0.2 * std::sqrt(2 / M_PI)).epsilon(0.05));
    CHECK(j["bias"].is_null());
    CHECK(j["z"].is_null());
    CHECK(j["nan"] == 0);
    CHECK(j["mean_ratio"].size() == 3);
    CHECK(j["missed"][0] == "mae<0.01");
    CHECK(j["verdict"] == "NOISY");
  }

  TEST_CASE("the test for bias as JSON") {
    const Gallery g;
    const auto run = [&](const char* image) {
      return nlohmann::json::parse(
          g.compare({image, "reference.exr", "--variance", "variance.exr", "--json"}).out);
    };
    const auto good = run("good.exr"), shifted = run("shifted.exr");
    CHECK(good["verdict"] == "no threshold given");
    CHECK(double(good["p"]) >= 0.01);
    CHECK(good["p"] == good["bias_test"]["p"]);
    CHECK(good["bias_test"]["significance"] == 0.01);
    CHECK(good["bias_test"]["tests"] == 198);
    CHECK(contains(good["known"], "no bias found"));
    // The error of the mean of 4096 values is 0.2 / 64, and 4.06 + 0.84 of them are noticed.
    CHECK(double(good["bias_test"]["noticed_mean"]) == doctest::Approx(0.0155).epsilon(0.2));
    CHECK(double(good["bias_test"]["noticed_tile"]) == doctest::Approx(0.125).epsilon(0.2));
    CHECK(shifted["verdict"] == "BIASED");
    CHECK(double(shifted["bias_test"]["mean"]["ratio"]) == doctest::Approx(1.05).epsilon(0.01));
    CHECK(int(shifted["bias_test"]["tile"]["width"]) == 8);
    CHECK(double(shifted["bias_test"]["bound95"]) > 0.05);
  }

  TEST_CASE("what was clipped for display is warned about") {
    const Gallery g;
    // good.exr is brighter than 1 in half of its values; the .png of differences is made for
    // display.
    CHECK(g.compare({"good.exr", "reference.exr", "--diff", "d.png"}).code == 0);
    const Outcome o = g.compare({"d.png", "good.exr", "--json", "--html", "r.html"});
    CHECK(contains(o.err, "above 1"));
    CHECK(contains(nlohmann::json::parse(o.out)["warning"], "the image is made for display"));
    CHECK(contains(read_file(g.path("r.html")), "made for display"));
    const Outcome other = g.compare({"good.exr", "d.png"});
    CHECK(contains(other.err, "the reference is made for display"));
    CHECK_FALSE(contains(g.compare({"d.png", "d.png"}).err, "made for display"));
    CHECK_FALSE(contains(g.compare({"good.exr", "shifted.exr"}).err, "made for display"));
    // Nothing of an image below 1 was clipped.
    write_noise(g.path("dim.exr"), 0, -0.5, 1, 64);
    CHECK_FALSE(contains(g.compare({"d.png", "dim.exr"}).err, "made for display"));
  }

  TEST_CASE("difference images") {
    const Gallery g;
    CHECK(g.compare({"shifted.exr", "reference.exr", "--diff", "d.png"}).code == 0);
    CHECK(read_image(g.path("d.png")).image.width == 64);
    CHECK(g.compare({"good.exr", "reference.exr", "--diff", "d.exr"}).code == 2);
    CHECK(g.compare({"good.exr", "reference.exr", "--diff", "/dev/null/d.png"}).code == 2);
  }

  TEST_CASE("what cannot be compared") {
    const Gallery g;
    g.write("no.exr", "nothing");
    const Outcome sizes = g.compare({"small.exr", "reference.exr"});
    CHECK(sizes.code == 1);
    CHECK(contains(sizes.err, "32x32"));
    CHECK(g.compare({"missing.exr", "reference.exr"}).code == 1);
    CHECK(g.compare({"no.exr", "reference.exr"}).code == 1);
    for (const char* wrong : {"rmse", "rmse<", "rmse<nan", "<1", "rmsee<1", "rmse<1x", "rmse<inf",
                              "bias<4", "z>0.9", "p>0.01"}) {
      CAPTURE(wrong);
      const Outcome o = g.compare({"good.exr", "reference.exr", "--require", wrong});
      CHECK(o.code == 2);
      CHECK(contains(o.err, "--require"));
    }
    for (const char* option : {"--spp", "--reference-spp"})
      for (const char* value : {"nan", "-1", "0", "1e99", "many"})
        CHECK(g.compare({"good.exr", "reference.exr", "--variance", "variance.exr", option, value})
                  .code == 2);
  }

  TEST_CASE("FLIP and the share of fireflies") {
    const Gallery g;
    const Outcome o = g.compare({"good.exr", "reference.exr", "--json"});
    const auto j = nlohmann::json::parse(o.out);
    CHECK(double(j["flip"]) > 0.01);
    CHECK(double(j["flip"]) < 1);
    CHECK(double(j["hdrflip"]) > 0.01);
    CHECK(double(j["firefly"]) == doctest::Approx(0.0015).epsilon(0.3));
    CHECK(double(j["worst"]) > 0.001);
    CHECK(j["tiles"].is_null());
    CHECK(g.compare({"good.exr", "reference.exr", "--require", "flip<0.001"}).code == 3);
    CHECK(g.compare({"good.exr", "reference.exr", "--require", "hdrflip<0.9", "--require",
                     "firefly<0.01", "--require", "worst<0.1"})
              .code == 0);
    // Of images for display the display's range is all there is.
    CHECK(g.compare({"good.exr", "reference.exr", "--diff", "d.png"}).code == 0);
    const auto display = nlohmann::json::parse(g.compare({"d.png", "d.png", "--json"}).out);
    CHECK(display["hdrflip"].is_null());
    CHECK(display["flip"] == 0);
  }

  TEST_CASE("false-colour images and FLIP maps") {
    const Gallery g;
    CHECK(g.compare(
               {"shifted.exr", "reference.exr", "--false-colour", "c.png", "--flip-map", "f.png"})
              .code == 0);
    CHECK(read_image(g.path("c.png")).image.width == 64);
    CHECK(read_image(g.path("f.png")).image.height == 64);
    CHECK(g.compare({"good.exr", "reference.exr", "--flip-map", "f.exr"}).code == 2);
    CHECK(g.compare({"good.exr", "reference.exr", "--false-colour", "/dev/null/c.png"}).code == 2);
  }

  TEST_CASE("sets of independent images") {
    const Gallery g;
    for (unsigned i = 0; i < 16; ++i) {
      write_noise(g.path("a-" + std::to_string(i) + ".exr"), 0.2, 0, 100 + i, 32);
      write_noise(g.path("b-" + std::to_string(i) + ".exr"), 0.3, 0, 200 + i, 32);
      write_noise(g.path("c-" + std::to_string(i) + ".exr"), 0.2, 0.02, 300 + i, 32);
    }
    const std::vector<std::string> limits{"--require", "tiles<1", "--require", "tilez2<1.6"};
    const auto batches = [&](const std::string& a, const std::string& b,
                             std::vector<std::string> more) {
      more.insert(more.begin(), {"--batches", a, b});
      return g.compare(more);
    };
    const Outcome equal = batches("a-*.exr", "b-*.exr", limits);
    CHECK(equal.code == 0);
    CHECK(verdict(equal) == "PASS");
    CHECK(contains(equal.out, "would have been noticed"));
    const Outcome biased = batches("c-*.exr", "b-*.exr", limits);
    CHECK(biased.code == 3);
    CHECK(verdict(biased) == "BIASED");
    const auto j = nlohmann::json::parse(batches("c-*.exr", "a-*.exr", {"--json"}).out);
    CHECK(double(j["tile_test"]["ratio"]) == doctest::Approx(1.02).epsilon(0.001));
    // 48 values of a tile in 16 images of either side, 4.6 standard errors and a little more.
    CHECK(double(j["tile_test"]["visible_bias"]) > 0.047);
    CHECK(double(j["tile_test"]["visible_bias"]) < 0.065);
    CHECK(int(j["tiles"]) == int(j["tile_test"]["rejected"]));
    // Names with commas and directories are as good; few images are worth a warning.
    const Outcome few = batches("a-1.exr,a-2.exr", "b-1.exr,b-2.exr,b-3.exr", {});
    CHECK(few.code == 0);
    CHECK(contains(few.err, "say little"));
    for (const char* side : {"left", "right"}) {
      std::filesystem::create_directory(g.path(side));
      for (int i = 0; i < 3; ++i)
        std::filesystem::copy(g.path("a-" + std::to_string(i) + ".exr"),
                              g.path(std::string(side) + "/" + std::to_string(i) + ".exr"));
    }
    CHECK(batches("left", "right", {"--html", "r.html"}).code == 0);
    CHECK(contains(read_file(g.path("r.html")), "tiles differ"));
    CHECK(batches("a-1.exr", "b-*.exr", {}).code == 2);
    CHECK(batches("z-*.exr", "b-*.exr", {}).code == 2);
    CHECK(batches("a-1.exr,small.exr,good.exr", "b-*.exr", {}).code == 1);
    CHECK(batches("a-1.exr,missing.exr", "b-*.exr", {}).code == 1);
    CHECK(batches("good.exr,shifted.exr", "b-*.exr", {}).code == 1);
    CHECK(batches("a-*.exr", "b-*.exr", {"--variance", "variance.exr"}).code == 2);
    CHECK(g.compare({"good.exr", "reference.exr", "--require", "tiles<1"}).code == 2);
    write_noise(g.path("a-99.exr"), 0.2, NAN, 7, 32);
    const Outcome holes = batches("a-*.exr", "b-*.exr", limits);
    CHECK(holes.code == 3);
    CHECK(verdict(holes) == "FAIL");
  }

  TEST_CASE("PSNR, SSIM, MAPE and SMAPE are figures like the others") {
    const Gallery g;
    const auto j = nlohmann::json::parse(g.compare({"good.exr", "reference.exr", "--json"}).out);
    CHECK(double(j["psnr"]) > 15);
    CHECK(double(j["psnr"]) < 40);
    CHECK(double(j["ssim"]) > 0);
    CHECK(double(j["ssim"]) < 0.9);
    CHECK(double(j["mape"]) == doctest::Approx(0.2 * std::sqrt(2 / M_PI) / 1.01).epsilon(0.05));
    CHECK(double(j["smape"]) == doctest::Approx(double(j["mape"])).epsilon(0.05));
    for (const char* fine : {"psnr>15", "ssim<0.9", "mape<0.2", "smape<0.2"})
      CHECK(g.compare({"good.exr", "reference.exr", "--require", fine}).code == 0);
    for (const char* missed : {"psnr>40", "ssim>0.9", "mape<0.1", "smape<0.1"})
      CHECK(g.compare({"good.exr", "reference.exr", "--require", missed}).code == 3);
    // Equal images have no error at all, which is more than any limit.
    const Outcome equal =
        g.compare({"good.exr", "good.exr", "--require", "psnr>200", "--html", "r.html"});
    CHECK(equal.code == 0);
    CHECK(contains(equal.out, "psnr       inf"));
    const std::string page = read_file(g.path("r.html"));
    CHECK(contains(page, "<td data-value=\"Infinity\">∞</td>"));
    for (const char* name : {"psnr", "ssim", "mape", "smape"})
      CHECK(contains(page, std::string("<tr><td>") + name + "</td><td data-value="));
    // Lines are wrapped anywhere.
    const std::string help = std::regex_replace(g.compare({"--help"}).out, std::regex("\\s+"), " ");
    for (const char* formula : {"10 log10(1 / mean of (a - b)^2)", "K1 0.01, K2 0.03",
                                "|a - b| / (|b| + 0.01)", "2 |a - b| / (|a| + |b| + 0.01)"})
      CHECK(contains(help, formula));
  }

  TEST_CASE("directories, with reports") {
    const Gallery g;
    for (const char* d : {"a", "b", "a/deep", "b/deep", "v"})
      std::filesystem::create_directory(g.path(d));
    const auto copy = [&](const char* from, const char* to) {
      std::filesystem::copy(g.path(from), g.path(to));
    };
    copy("good.exr", "a/one.exr");
    copy("reference.exr", "b/one.exr");
    copy("shifted.exr", "a/deep/<two>.exr");
    copy("reference.exr", "b/deep/<two>.exr");
    const Outcome fine =
        g.compare({"a", "b", "--require", "relrmse<0.25", "--html", "r.html", "--junit", "j.xml"});
    CHECK(fine.code == 0);
    CHECK(contains(fine.out, "deep/<two>.exr  PASS"));
    const std::string page = read_file(g.path("r.html"));
    CHECK(contains(page, "deep/&lt;two&gt;.exr"));
    CHECK_FALSE(contains(page, "<two>"));
    CHECK_FALSE(contains(page, "http:"));
    CHECK_FALSE(contains(page, "https:"));
    CHECK_FALSE(contains(page, " src="));
    size_t viewers = 0;
    for (size_t at = 0; (at = page.find("class=\"viewer\"><script", at)) != std::string::npos; ++at)
      ++viewers;
    CHECK(viewers == 2);
    CHECK(contains(read_file(g.path("j.xml")), "tests=\"2\" failures=\"0\" errors=\"0\""));

    const Outcome missed = g.compare({"a", "b", "--require", "ratio<0.02", "--junit", "j.xml"});
    CHECK(missed.code == 3);
    CHECK(contains(missed.out, "missed: ratio<0.02"));
    const std::string junit = read_file(g.path("j.xml"));
    CHECK(contains(junit, "tests=\"2\" failures=\"1\" errors=\"0\""));
    CHECK(contains(junit, "ratio&lt;0.02 is not met: 0.0"));

    copy("variance.exr", "v/one.exr");
    const auto with = nlohmann::json::parse(
        g.compare({"a", "b", "--json", "--variance", "v", "--spp", "16", "--reference-spp", "16"})
            .out);
    REQUIRE(with.size() == 2);
    CHECK_FALSE(with[1]["bias"].is_null());
    CHECK(contains(with[0]["error"], "v/deep/<two>.exr"));
    CHECK(with[0]["verdict"] == "ERROR");
    std::filesystem::create_directory(g.path("empty"));
    CHECK(g.compare({"a", "empty"}).code == 1);
    CHECK(g.compare({"a", "b", "--diff", "d.png"}).code == 2);
    CHECK(g.compare({"a", "b", "--variance", "variance.exr"}).code == 2);
    CHECK(g.compare({"a", "b", "--html", "/dev/null/r.html"}).code == 2);
  }
}
