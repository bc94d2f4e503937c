// Values that make no sense, for every flag there is: exit code 2 and a message.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "app/workplace.h"

using namespace duet::test;

namespace {

/// The command is refused with exit code 2 and a message that names what is wrong, and leaves
/// nothing behind.
void check_refused(const Workplace& place, const Arguments& arguments, const std::string& named) {
  std::string line;
  for (const std::string& a : arguments) line += " " + a;
  CAPTURE(line);
  const size_t files = place.count();
  const Outcome o = place.run(arguments);
  CAPTURE(o.err);
  CHECK(o.code == 2);
  CHECK(contains(o.err, "duet: error: "));
  CHECK(contains(o.err, named));
  CHECK(o.out.empty());
  CHECK(place.count() == files);
}

/// The words with one space between them.
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("numbers that make no sense are refused for every flag") {
    const Workplace place;
    place.scene();
    const std::pair<const char*, const char*> flags[] = {
        {"--spp", "--spp"},
        {"--time", "--time"},
        {"--target-error", "--target-error"},
        {"--size", "--size"},
        {"--crop", "--crop"},
        {"--sensor", "sensor"},
        {"--seed", "--seed"},
        {"--threads", "--threads"},
        {"--define", "-D"},
        {"--parameter", "-I"},
        {"--aov", "layer"},
        {"--progress", "--progress"},
        {"--integrator", "integrator"},
        {"--exposure", "--exposure"},
    };
    for (const auto& [flag, named] : flags)
      for (const char* value : {"nan", "-1", "1e99", "99999999999999999999999", "x"}) {
        const std::string argument = std::string(flag) + "=" + value;
        if (argument != "--exposure=-1") check_refused(place, {"tiny.xml", argument}, named);
      }
  }

  TEST_CASE("values of the wrong form are refused") {
    const Workplace place;
    place.scene();
    const std::pair<Arguments, const char*> cases[] = {
        {{"--spp", "0"}, "--spp"},
        {{"--spp", "1.5"}, "--spp"},
        {{"--spp", "4", "--spp", "8"}, "--spp"},
        {{"--time", "0"}, "--time"},
        {{"--time", "5 parsecs"}, "--time"},
        {{"--time", "9999h"}, "--time"},
        {{"--time", "inf"}, "--time"},
        {{"--target-error", "0"}, "--target-error"},
        {{"--target-error", "500%"}, "--target-error"},
        {{"--size", "16"}, "--size"},
        {{"--size", "16x"}, "--size"},
        {{"--size", "16x16x16"}, "--size"},
        {{"--size", "0x16"}, "--size"},
        {{"--size", "16x70000"}, "--size"},
        {{"--crop", "0,0,4"}, "--crop"},
        {{"--crop", "0,0,0,4"}, "--crop"},
        {{"--crop", "-1,0,4,4"}, "--crop"},
        {{"--crop", "10,0,8,4"}, "--crop"},
        {{"--crop", "2147483647,0,2147483647,4"}, "--crop"},
        {{"-s", "1"}, "1 sensor"},
        {{"-t", "0"}, "--threads"},
        {{"-t", "100000"}, "--threads"},
        {{"-D", "spp"}, "NAME=VALUE"},
        {{"-D", "=3"}, "NAME=VALUE"},
        {{"-D", "sp=3"}, "did you mean \"spp\"?"},
        {{"-I", "max_depth"}, "NAME=VALUE"},
        {{"-I", "max_dept=3"}, "did you mean \"max_depth\"?"},
        {{"-I", "max_depth=-2"}, "max_depth"},
        {{"-I", "max_depth=3.5"}, "max_depth"},
        {{"-I", "max_depth=99999999999"}, "max_depth"},
        {{"-I", "hide_emitters=maybe"}, "hide_emitters"},
        {{"-i", "direct", "-I", "bsdf_samples=1000000000"}, "bsdf_samples"},
        {{"-i", "direct", "-I", "bsdf_samples=0", "-I", "emitter_samples=0"}, "samples"},
        {{"-i", "bdpt", "-I", "light_paths=-1"}, "light_paths"},
        {{"-i", "ptracer", "-I", "strict_normals=true"}, "strict_normals"},
        {{"-i", "ptracer", "--light-selection", "bvh"}, "light_selection"},
        {{"--light-selection", "tree"}, "--light-selection"},
        {{"-i", "vcm", "-I", "alpha=2"}, "alpha"},
        {{"-i", "bpm", "-I", "radius=-1"}, "radius"},
        {{"-i", "reuse", "-I", "thesis_reading=a"}, "weights=thesis"},
        {{"-i", "reuse", "-I", "max_eye_depht=3"}, "did you mean \"max_eye_depth\"?"},
        {{"-i", "sppm"}, "did you mean \"ppm\"?"},
        {{"-i", "pathh"}, "did you mean \"path\"?"},
        {{"-i", "aov"}, "layers"},
        {{"-i", "aov", "--aov", "variance"}, "variance"},
        {{"-i", "aov", "--aov", "albedo", "--target-error", "0.1"}, "--target-error"},
        {{"-i", "aov", "--aov", "albedo", "-o", "a.png"}, "a.png"},
        {{"--aov", "albedoo"}, "did you mean \"albedo\"?"},
        {{"--exposure", "1e9"}, "--exposure"},
        {{"--progress", "fancy"}, "--progress"},
        {{"-q", "-v"}, "--verbose"},
        {{"-o", "a.bmp"}, ".exr"},
        {{"-o", "{scen}.exr"}, "{scene}"},
        {{"-o", "{scene.exr"}, "{scene}"},
        {{"-x", "--time", "1", "-o", "{spp}.exr"}, "{spp}"},
        {{"-a", "nowhere"}, "nowhere"},
        {{"--stats", "tiny.xml/stats.json"}, "tiny.xml"},
        {{"--stats", "."}, "directory"},
        {{"--log", "."}, "--log"},
        {{"--frobnicate"}, "frobnicate"},
    };
    for (const auto& [flags, named] : cases) {
      Arguments arguments{"tiny.xml"};
      arguments.insert(arguments.end(), flags.begin(), flags.end());
      check_refused(place, arguments, named);
    }
  }

  TEST_CASE("calls without sense are refused") {
    const Workplace place;
    place.scene();
    check_refused(place, {}, "subcommand");
    check_refused(place, {"render"}, "scene");
    check_refused(place, {"-q"}, "scene");
    check_refused(place, {"rendr", "tiny.xml"}, "did you mean \"render\"?");
    check_refused(place, {"help", "rendr"}, "did you mean \"render\"?");
    check_refused(place, {"hlep"}, "did you mean \"help\"?");
    check_refused(place, {"info"}, "scene");
    check_refused(place, {"info", "tiny.xml", "--json", "--xml"}, "--xml");
    check_refused(place, {"info", "tiny.xml", "tiny.xml", "--xml"}, "--xml");
    check_refused(place, {"info", "tiny.xml", "-D", "x=1"}, "$spp");
    check_refused(place, {"plugins", "bsd"}, "did you mean \"bsdf\"?");
    check_refused(place, {"plugins", "bsdf", "--markdown"}, "--markdown");
    check_refused(place, {"compare", "a.exr"}, "reference");
  }

  TEST_CASE("several scenes need several files") {
    const Workplace place;
    place.scene("a.xml");
    place.scene("b.xml");
    std::filesystem::create_directory(place.path("other"));
    place.scene("other/a.xml");
    check_refused(place, {"a.xml", "b.xml", "-o", "out.exr"}, "out.exr");
    check_refused(place, {"a.xml", "other/a.xml"}, "a.xml and other/a.xml");
    check_refused(place, {"a.xml", "a.xml"}, "a.xml and a.xml");
    check_refused(place, {"a.xml", "b.xml", "-o", "{seed}.exr"}, "{scene}");
  }

  TEST_CASE("a file with two uses in one call is refused") {
    const Workplace place;
    place.scene();
    place.write("film.exr", "a");
    place.write("c.png", "a");
    std::filesystem::create_symlink(place.path("film.exr"), place.path("link.exr"));
    const char* named = "this file has another use in this call";
    const Arguments calls[] = {
        {"tiny.xml", "-o", "a.exr", "--raw", "./a.exr"},
        {"tiny.xml", "-o", "a.exr", "-o", "a.exr"},
        {"tiny.xml", "-o", "{spp}.exr", "-o", "4.exr"},
        {"tiny.xml", "-o", "a.exr", "-o", "a.checkpoint.exr", "--checkpoint", "60s"},
        {"tiny.xml", "--stats", "tiny.exr"},
        {"tiny.xml", "--log", "tiny.xml"},
        {"tiny.xml", "--log", "l", "--stats", "l"},
        {"tiny.xml", "--resume", "film.exr", "-o", "link.exr"},
        {"merge", "film.exr", "-o", "a.exr", "--raw", "a.exr"},
        {"merge", "film.exr", "-o", "link.exr"},
        {"merge", "film.exr", "-o", "a.png", "--png", "a.png"},
        {"view", "film.exr", "-o", "link.exr"},
        {"compare", "c.png", "film.exr", "--diff", "./c.png"},
        {"compare", "c.png", "film.exr", "--html", "h", "--junit", "h"},
        {"compare", "--batches", "c.png,film.exr", "c.png,film.exr", "--diff", "c.png"},
        {"slurm", "tiny.xml", "--tasks", "2", "--dry-run", "-o", "a.exr", "-o", "a.exr"},
    };
    for (const Arguments& arguments : calls) check_refused(place, arguments, named);
    CHECK(read_file(place.path("film.exr")) == "a");
    CHECK(read_file(place.path("c.png")) == "a");
  }

  TEST_CASE("help is complete and has examples") {
    const Workplace place;
    const std::pair<Arguments, Arguments> cases[] = {
        {{"--help"},
         {"render", "batch", "info", "compare", "plugins", "stability", "--version",
          "duet SCENE..."}},
        {{"render", "--help"},
         {"--output",
          "--integrator",
          "-I",
          "--spp",
          "--time",
          "--target-error",
          "--size",
          "--crop",
          "--sensor",
          "--seed",
          "--threads",
          "-D",
          "-a",
          "--aov",
          "--stats",
          "--strict",
          "--strict-sampler",
          "--light-selection",
          "--skip-existing",
          "--keep-going",
          "--quiet",
          "--verbose",
          "--progress",
          "--log",
          "--exposure",
          "Examples:",
          "Exit codes:",
          "albedo",
          "path",
          "ptracer (light tracing",
          "bdpt (bidirectional path tracing)",
          "vcm (vertex connection and merging)"}},
        {{"batch", "--help"},
         {"--output", "--jobs", "--threads", "--report", "--junit", "--csv", "--dry-run",
          "Examples:", "Exit codes:"}},
        {{"info", "--help"}, {"-D", "-a", "--strict", "--xml", "Examples:"}},
        {{"compare", "--help"}, {"--variance", "--spp",     "--reference-spp",
                                 "--diff",     "--require", "--json",
                                 "rmse",       "relrmse",   "relmse",
                                 "trimmed",    "mae",       "ratio",
                                 "bias",       "zrms",      "nan",
                                 "negative",   "PASS",      "NOISY",
                                 "BIASED",     "FAIL",      "Examples:"}},
        {{"chart", "--help"}, {"--reference", "--time", "--external", "Examples:"}},
        {{"plugins", "--help"}, {"--markdown", "kind", "Examples:"}},
        {{"stability", "--help"},
         {"--fast", "--methods", "--list", "--markdown", "--json", "--catalogue", "Exit codes",
          "Examples:"}},
    };
    for (const auto& [arguments, parts] : cases) {
      const Outcome o = place.run(arguments);
      CHECK(o.code == 0);
      CHECK(o.err.empty());
      const std::string text = in_one_line(o.out);
      for (const std::string& part : parts) {
        CAPTURE(part);
        CHECK(contains(text, part));
      }
    }
    CHECK(place.run({"help"}).out == place.run({"--help"}).out);
    CHECK(place.run({"help", "render"}).out == place.run({"render", "--help"}).out);
    CHECK(place.run({"help", "render"}).code == 0);
    const Outcome version = place.run({"--version"});
    CHECK(version.code == 0);
    CHECK(version.out == "duet " DUET_VERSION "\n");
  }

  TEST_CASE("an option without a value is refused, and takes no other option for it") {
    const Workplace place;
    place.scene();
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"render", "tiny.xml", "--log=", "--strict"},
             {"tiny.xml", "--spp", ""},
             {"tiny.xml", "-o", "tiny.exr", "--seed", ""},
             {"batch", "tiny.xml", "-o", "tiny.exr", "--csv=", "--dry-run"},
             {"compare", "a.exr", "b.exr", "--html", ""}}) {
      const Outcome o = place.run(arguments);
      CAPTURE(o.err);
      CHECK(o.code == 2);
      CHECK((contains(o.err, "= has no value") || contains(o.err, "the value is empty")));
      CHECK(!std::filesystem::exists(place.path("--strict")));
    }
  }

  TEST_CASE("help fits the width") {
    const Workplace place;
    for (const char* command :
         {"", "render", "batch", "info", "compare", "chart", "plugins", "stability"}) {
      Arguments arguments{"--help"};
      if (*command != '\0') arguments.insert(arguments.begin(), command);
      std::istringstream lines(place.run(arguments).out);
      size_t count = 0;
      for (std::string line; std::getline(lines, line); ++count) {
        CAPTURE(command);
        CAPTURE(line);
        const auto is_start = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
        CHECK(std::count_if(line.begin(), line.end(), is_start) <= 80);
        CHECK(!line.ends_with(' '));
      }
      CHECK(count > 10);
    }
    const std::string chart = place.run({"chart", "--help"}).out;
    CHECK(contains(chart, "mean.exr' \\\n      --variance"));
  }

  TEST_CASE("results that cannot be printed are a failure") {
    const Workplace place;
    for (const char* argument : {"plugins", "--help"}) {
      const Outcome o = run_duet({argument}, {.directory = place.path(""), .output = "/dev/full"});
      CHECK(o.code == 1);
      CHECK(contains(o.err, "write"));
    }
  }
}
