// duet compare: figures, verdicts and exit codes.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

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
    CHECK(verdict(plain) == "PASS");
    CHECK(contains(plain.out, "bias       not available"));
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
    CHECK(verdict(g.compare({"good.exr", "reference.exr", "--variance", "variance.exr"})) ==
          "PASS");
    CHECK(verdict(g.compare({"good.exr", "reference.exr", "--variance", "variance.exr", "--spp",
                             "1600"})) == "BIASED");
    CHECK(verdict(g.compare({"shifted.exr", "reference.exr", "--variance", "variance.exr",
                             "--reference-spp", "0.01"})) == "PASS");
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

  TEST_CASE("difference images") {
    const Gallery g;
    CHECK(g.compare({"shifted.exr", "reference.exr", "--diff", "d.png"}).code == 0);
    CHECK(read_image(g.path("d.png")).image.width == 64);
    CHECK(g.compare({"good.exr", "reference.exr", "--diff", "d.exr"}).code == 2);
    CHECK(g.compare({"good.exr", "reference.exr", "--diff", "nowhere/d.png"}).code == 2);
  }

  TEST_CASE("what cannot be compared") {
    const Gallery g;
    g.write("no.exr", "nothing");
    const Outcome sizes = g.compare({"small.exr", "reference.exr"});
    CHECK(sizes.code == 1);
    CHECK(contains(sizes.err, "32x32"));
    CHECK(g.compare({"missing.exr", "reference.exr"}).code == 1);
    CHECK(g.compare({"no.exr", "reference.exr"}).code == 1);
    for (const char* wrong :
         {"rmse", "rmse<", "rmse<nan", "<1", "rmsee<1", "rmse<1x", "rmse<inf", "bias<4", "z>0.9"}) {
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
}
