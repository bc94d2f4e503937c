// Renders in parts: slices, checkpoints, raw films and what can be wrong with them.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "app/workplace.h"
#include "image/image_io.h"
#include "support/image_header.h"

using namespace duet;
using namespace duet::test;

namespace {

/// One whose images keep all bits and that takes a while: light within a white sphere.
TinyScene long_scene() {
  TinyScene s = endless_scene();
  s.film = exact_scene().film;
  return s;
}

void check_same_pixels(const std::string& a, const std::string& b) {
  const Image of_a = read_image(a).image, of_b = read_image(b).image;
  REQUIRE(of_a.data.size() == of_b.data.size());
  CHECK(std::memcmp(of_a.data.data(), of_b.data.data(), of_a.data.size() * sizeof(float)) == 0);
}

std::string field(const std::string& path, const std::string& name) {
  return header_field(read_image(path), name);
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("slices are merged to the image of one render") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.run({"tiny.xml", "--spp", "10", "-o", "whole.exr"}).code == 0);
    for (const char* k : {"1", "2", "3"}) {
      const Outcome o = place.run({"tiny.xml", "--spp", "10", "--slice", std::string(k) + "/3",
                                   "--raw", std::string(k) + ".exr", "-t", k});
      CAPTURE(o.err);
      CHECK(o.code == 0);
    }
    CHECK(!place.has("tiny.exr"));
    const Outcome o = place.run({"merge", "2.exr", "3.exr", "1.exr", "-o", "m.exr", "--png",
                                 "m.png", "--raw", "all.exr", "--stats", "s.json"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    check_same_pixels(place.path("m.exr"), place.path("whole.exr"));
    CHECK(field(place.path("m.exr"), "slices") == "3");
    CHECK(field(place.path("m.exr"), "spp") == "10");
    CHECK(field(place.path("m.exr"), "scene") == "tiny.xml");
    CHECK(field(place.path("m.exr"), "worldToCamera") ==
          field(place.path("whole.exr"), "worldToCamera"));
    CHECK(place.has("m.png"));
    const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
    CHECK(stats["paths"]["camera"] == 16 * 12 * 10);
    CHECK(stats["spp"] == 10);

    // A lost slice is named, and the image is of the others.
    const Outcome lost = place.run({"merge", "1.exr", "3.exr", "-o", "m.exr"});
    CHECK(lost.code == 0);
    CHECK(contains(lost.err, "samples are missing: 3:6"));
    CHECK(field(place.path("m.exr"), "missingSamples") == "3:6");

    // More samples than there are.
    REQUIRE(place.run({"tiny.xml", "--spp", "25", "-o", "whole.exr"}).code == 0);
    REQUIRE(place.run({"tiny.xml", "--spp", "25", "--resume", "all.exr", "-o", "more.exr"}).code ==
            0);
    check_same_pixels(place.path("more.exr"), place.path("whole.exr"));
  }

  TEST_CASE("layers are merged to .exr files only") {
    const Workplace place;
    TinyScene layers = exact_scene();
    layers.integrator =
        R"(<integrator type="aov"><string name="aovs" value="d:depth"/></integrator>)";
    place.scene("layers.xml", layers);
    REQUIRE(place.run({"layers.xml", "--raw", "l.exr"}).code == 0);
    const Outcome o = place.run({"merge", "l.exr", "-o", "a.exr", "--png", "a.png"});
    CHECK(o.code == 2);
    CHECK(contains(o.err, "-o a.png: the image has layers only"));
    CHECK(!place.has("a.exr"));
    CHECK(place.run({"merge", "l.exr", "-o", "a.exr"}).code == 0);
    CHECK(place.run({"layers.xml", "-o", "b.exr"}).code == 0);
    check_same_pixels(place.path("a.exr"), place.path("b.exr"));

    // Layers beside colours need an .exr file, too.
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.run({"tiny.xml", "--aov", "depth", "--raw", "m.exr"}).code == 0);
    const Outcome lost = place.run({"merge", "m.exr", "-o", "m.png"});
    CHECK(lost.code == 2);
    CHECK(contains(lost.err, "only .exr files can hold the other layers (depth"));
    CHECK(place.run({"merge", "m.exr", "-o", "m.png", "-o", "all.exr"}).code == 0);
  }

  TEST_CASE("a render that is killed again and again goes on") {
    const Workplace place;
    place.scene("long.xml", long_scene());
    std::mt19937 random(4);
    int kills = 0;
    for (const char* method : {"path", "bdpt", "vcm"}) {
      CAPTURE(method);
      const Arguments render{"long.xml", "-i", method, "-I", "max_depth=60", "-t", "1", "--spp"};
      // As many samples as take about two seconds here.
      const Outcome probe =
          place.run(render + Arguments{"16", "-o", "probe.exr", "--stats", "s.json"});
      REQUIRE(probe.code == 0);
      const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
      const double seconds = stats["seconds"]["render"];
      const std::string spp = std::to_string(int(std::clamp(16 * 2 / seconds, 32.0, 20000.0)));
      REQUIRE(place.run(render + Arguments{spp, "-o", "whole.exr"}).code == 0);
      const Arguments part = render + Arguments{spp, "-o", "part.exr", "--checkpoint", "0.02s"};
      const std::string checkpoint = place.path("part.checkpoint.exr");
      std::filesystem::remove(place.path("part.exr"));
      // Killed before the first checkpoint, and five times at some moment after one more was
      // written, so that every machine gets to the end.
      for (int i = 0; i < 6 && !place.has("part.exr"); ++i) {
        const auto written = [&] {
          std::error_code none;
          return std::filesystem::last_write_time(checkpoint, none);
        };
        const auto before = written();
        Process duet(part, {.directory = place.path("")});
        if (i > 0)
          REQUIRE(Process::wait_until([&] { return written() != before || place.has("part.exr"); },
                                      300));
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 60));
        duet.send(SIGKILL);
        if (duet.wait(300).code != 0) ++kills;
      }
      // A kill may have come after the image and before its checkpoint was removed.
      if (!place.has("part.exr") || place.has("part.checkpoint.exr"))
        REQUIRE(place.run(part).code == 0);
      check_same_pixels(place.path("part.exr"), place.path("whole.exr"));
      CHECK(!place.has("part.checkpoint.exr"));
    }
    CHECK(kills >= 9);
  }

  TEST_CASE("Ctrl-C and SIGTERM leave a checkpoint, and -x takes it for unfinished") {
    const Workplace place;
    place.scene("long.xml", long_scene());
    for (const int signal : {SIGINT, SIGTERM}) {
      const Arguments render{"long.xml", "--spp",        "1000000", "-o",
                             "a.exr",    "--checkpoint", "0.1s",    "-x"};
      const std::string checkpoint = place.path("a.checkpoint.exr");
      uint64_t before = 0;
      for (int i = 0; i < 2; ++i) {
        const auto written = [&] { return std::filesystem::file_size(checkpoint); };
        const uintmax_t size = i == 0 ? 0 : written();
        Process duet(render, {.directory = place.path("")});
        REQUIRE(Process::wait_until(
            [&] { return place.has("a.checkpoint.exr") && written() != size; }, 300));
        duet.send(signal);
        const Outcome o = duet.wait(300);
        CAPTURE(o.err);
        CHECK(o.code == 128 + signal);
        CHECK(contains(o.err, "goes on from a.checkpoint.exr") == (i == 1));
        const uint64_t spp = std::stoull(field(place.path("a.partial.exr"), "spp"));
        CHECK(spp > before);
        before = spp;
      }
      CHECK(!place.has("a.exr"));
      const Outcome o = place.run(
          {"long.xml", "--spp", std::to_string(before), "-o", "a.exr", "--checkpoint", "1h", "-x"});
      CHECK(o.code == 0);
      CHECK(field(place.path("a.exr"), "spp") == std::to_string(before));
      CHECK(!place.has("a.checkpoint.exr"));
      std::filesystem::remove(place.path("a.exr"));
    }
  }

  TEST_CASE("renders to a time and to an error go on, and are not cut") {
    const Workplace place;
    place.scene("long.xml", long_scene());
    for (const Arguments& limit : {Arguments{"--time", "2s"}, Arguments{"--target-error", "1%"}}) {
      const Arguments render = Arguments{"long.xml", "--raw", "film.exr", "-o", "a.exr"} + limit;
      {
        Process duet(render + Arguments{"--progress", "bar"}, {.directory = place.path("")});
        REQUIRE(duet.wait_for_message("error", 300));
        duet.send(SIGINT);
        CHECK(duet.wait(300).code == 130);
      }
      REQUIRE(place.has("film.exr"));
      const Outcome o = place.run(render + Arguments{"--resume", "film.exr"});
      CAPTURE(o.err);
      CHECK(o.code == 0);
      CHECK(contains(o.err, "goes on from film.exr"));
      const Outcome merged = place.run({"merge", "film.exr", "-o", "m.exr"});
      CHECK(merged.code == 0);
      check_same_pixels(place.path("m.exr"), place.path("a.exr"));
      CHECK(place.run(render + Arguments{"--slice", "1/2"}).code == 2);
      std::filesystem::remove(place.path("film.exr"));
    }
  }

  TEST_CASE("what auto has decided is in the raw film") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.run({"tiny.xml", "-i", "auto", "--spp", "4", "--raw", "a.exr"}).code == 0);
    const Outcome o = place.run(
        {"tiny.xml", "-i", "auto", "--spp", "8", "--resume", "a.exr", "-v", "-o", "b.exr"});
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(contains(o.err, "auto chose"));
    CHECK(!field(place.path("b.exr"), "chosenIntegrator").empty());
  }

  TEST_CASE("a film of another scene, or of other settings, is refused and stays") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.run({"tiny.xml", "--raw", "a.exr"}).code == 0);
    const std::string film = read_file(place.path("a.exr"));
    const auto refused = [&](const Arguments& more, const std::string& what) {
      const Outcome o =
          place.run(Arguments{"tiny.xml", "--raw", "a.exr", "--checkpoint", "1s"} + more);
      CAPTURE(o.err);
      CHECK(o.code == 1);
      CHECK(contains(o.err, "a.exr: is not of this image: " + what));
      CHECK(read_file(place.path("a.exr")) == film);
    };
    refused({"--seed", "3"}, "\"seed\" is 0, not 3");
    refused({"-i", "bdpt"}, "\"integrator\" is \"path\", not \"bdpt\"");
    refused({"-I", "max_depth=3"}, "\"parameters\"");
    refused({"--size", "20x10"}, "\"scene\"");
    refused({"--crop", "0,0,4,4"}, "\"window\" is [0,0,16,12], not [0,0,4,4]");
    refused({"--aov", "depth"}, "\"channels\"");
    TinyScene other = exact_scene();
    other.extra = "<emitter type='constant'/>";
    place.scene("tiny.xml", other);
    refused({}, "\"scene\"");
    // A checkpoint that nobody has named is set aside.
    place.write("b.checkpoint.exr", film);
    const Outcome anew = place.run({"tiny.xml", "-o", "b.exr", "--checkpoint", "1s"});
    CAPTURE(anew.err);
    CHECK(anew.code == 0);
    CHECK(contains(anew.err, "b.checkpoint.exr: is not of this image: \"scene\""));
    CHECK(read_file(place.path("b.checkpoint.old.exr")) == film);
    CHECK(place.has("b.exr"));
    place.write("b.checkpoint.exr", "no film");
    CHECK(place.run({"tiny.xml", "-o", "b.exr", "--checkpoint", "1s"}).code == 0);
    CHECK(read_file(place.path("b.checkpoint.old.exr")) == film);
    CHECK(read_file(place.path("b.checkpoint.old-2.exr")) == "no film");
    // The number of samples is not part of the scene, nor is the file's name.
    TinyScene same = exact_scene();
    place.scene("renamed.xml", same);
    CHECK(place.run({"renamed.xml", "--raw", "a.exr", "--checkpoint", "1s", "-D", "spp=9"}).code ==
          0);
  }

  TEST_CASE("a film with samples that a slice does not have is refused and stays") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    const Arguments eight{"tiny.xml", "--spp", "8"};
    REQUIRE(place.run(eight + Arguments{"--raw", "all.exr"}).code == 0);
    const std::string film = read_file(place.path("all.exr"));
    const Outcome o =
        place.run(eight + Arguments{"--resume", "all.exr", "--slice", "2/4", "--raw", "b.exr"});
    CHECK(o.code == 1);
    CHECK(contains(o.err, "all.exr: has the samples 0:2, 4:8, and only 2:4 are asked for"));
    CHECK(!place.has("b.exr"));
    const Outcome same =
        place.run(eight + Arguments{"--samples", "0:7", "--raw", "all.exr", "--checkpoint", "1s"});
    CHECK(same.code == 1);
    CHECK(contains(same.err, "all.exr: has the samples 7:8, and only 0:7 are asked for"));
    CHECK(read_file(place.path("all.exr")) == film);
    CHECK(place.run(eight + Arguments{"--resume", "all.exr", "--samples", "0:9", "--raw", "b.exr"})
              .code == 0);
  }

  TEST_CASE("merge refuses films for which there is no memory") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.run({"tiny.xml", "--spp", "2", "--size", "900x900", "--raw", "a.exr"}).code == 0);
    const ProcessOptions little{.directory = place.path(""),
                                .environment = {{"DUET_MEMORY_LIMIT", "60000000"}}};
    const Outcome o = run_duet({"merge", "a.exr", "-o", "b.exr"}, little);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "the limit is 60 MB"));
    CHECK(!place.has("b.exr"));
    CHECK(place.run({"merge", "a.exr", "-o", "b.exr"}).code == 0);
  }

  TEST_CASE("a checkpoint that cannot be written is an error, and the one before stays") {
    const Workplace place;
    place.scene("long.xml", long_scene());
    const Arguments render{"long.xml", "--spp",        "300",  "--raw",
                           "film.exr", "--checkpoint", "0.01s"};
    REQUIRE(place.run({"long.xml", "--spp", "3", "--raw", "film.exr"}).code == 0);
    const std::string before = read_file(place.path("film.exr"));
    const Outcome o = run_duet(render, {.directory = place.path(""), .file_limit = 512});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "film.exr cannot be written"));
    CHECK(read_file(place.path("film.exr")) == before);
    CHECK(place.count() == 2);  // nothing half-written
    const Outcome nowhere = place.run({"long.xml", "--raw", "/dev/null/film.exr"});
    CHECK(nowhere.code == 1);
    CHECK(contains(nowhere.err, "cannot write /dev/null/film.exr"));
    CHECK(place.run({"merge", "film.exr", "-o", "/dev/null/a.exr"}).code == 1);
  }

  TEST_CASE("the image is written although the raw film cannot be") {
    const Workplace place;
    place.scene();
    const Arguments render{"tiny.xml", "--spp", "2", "-o", "a.exr", "--raw", "film.exr"};
    REQUIRE(place.run(render).code == 0);
    const std::string image = place.path("a.exr"), film = place.path("film.exr");
    const size_t small = std::filesystem::file_size(image),
                 large = std::filesystem::file_size(film);
    REQUIRE(small < large);
    std::filesystem::remove(image), std::filesystem::remove(film);
    const Outcome o =
        run_duet(render, {.directory = place.path(""), .file_limit = (small + large) / 2});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "film.exr cannot be written"));
    CHECK(place.has("a.exr"));
    CHECK(!place.has("film.exr"));

    // If neither can be, both are named.
    std::filesystem::remove(image);
    const Outcome neither = run_duet(render, {.directory = place.path(""), .file_limit = 512});
    CAPTURE(neither.err);
    CHECK(neither.code == 1);
    CHECK(contains(neither.err, "film.exr cannot be written"));
    CHECK(contains(neither.err, "; a.exr cannot be written"));

    // The same of a merge.
    REQUIRE(place.run(render).code == 0);
    const Outcome merged =
        run_duet({"merge", "film.exr", "--raw", "all.exr", "-o", "m.exr"},
                 {.directory = place.path(""), .file_limit = (small + large) / 2});
    CAPTURE(merged.err);
    CHECK(merged.code == 1);
    CHECK(contains(merged.err, "all.exr cannot be written"));
    CHECK(place.has("m.exr"));
    CHECK(!place.has("all.exr"));
  }

  TEST_CASE("merge says that a file would be too large, and does not wait for pipes") {
    const Workplace place;
    place.scene();
    REQUIRE(place.run({"tiny.xml", "--spp", "2", "--raw", "film.exr"}).code == 0);
    const Outcome o = run_duet({"merge", "film.exr", "-o", "a.exr"},
                               {.directory = place.path(""), .file_limit = 512});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "a.exr cannot be written"));
    REQUIRE(mkfifo(place.path("pipe").c_str(), 0600) == 0);
    for (const Arguments& arguments :
         {Arguments{"merge", "pipe", "-o", "a.exr"}, Arguments{"tiny.xml", "--resume", "pipe"},
          Arguments{"compare", "pipe", "pipe"}}) {
      const Outcome waits = place.run(arguments);
      CAPTURE(waits.err);
      CHECK(waits.code == 1);
      CHECK(contains(waits.err, "pipe"));
    }
  }

  TEST_CASE("raw films: what makes no sense on the command line") {
    const Workplace place;
    place.scene("tiny.xml");
    place.scene("other.xml");
    const auto wrong = [&](const Arguments& arguments, const std::string& message) {
      const Outcome o = place.run(arguments);
      CAPTURE(o.err);
      CHECK(o.code == 2);
      CHECK(contains(o.err, message));
    };
    const Arguments raw{"tiny.xml", "--raw", "a.exr"};
    wrong(raw + Arguments{"--slice", "4/3"}, "--slice 4/3: the parts are 1/3 to 3/3");
    wrong(raw + Arguments{"--slice", "0/3"}, "1/3 to 3/3");
    wrong(raw + Arguments{"--slice", "3"}, "K/N");
    wrong(raw + Arguments{"--slice", "5/5", "--spp", "4"}, "4 samples per pixel have no 5 parts");
    wrong(raw + Arguments{"--samples", "5:5"}, "there are no such samples");
    wrong(raw + Arguments{"--samples", "0:2", "--slice", "1/2"}, "--samples already");
    wrong(raw + Arguments{"--samples", "0:2", "--time", "1s"}, "cannot be cut");
    wrong({"tiny.xml", "--slice", "1/2"}, "name it with --raw");
    wrong({"tiny.xml", "--raw", "a.png"}, "raw films are .exr files");
    wrong({"tiny.xml", "--raw", "-"}, "standard output");
    wrong({"tiny.xml", "other.xml", "--raw", "a.exr"}, "written to one file");
    wrong({"tiny.xml", "other.xml", "--resume", "a.exr"}, "one scene");
    wrong(raw + Arguments{"-x"}, "writes no image");
    wrong({"tiny.xml", "-o", "a.exr", "--checkpoint", "often"}, "--checkpoint");
    wrong({"merge", "a.exr"}, "has to name a file");
    wrong({"merge", "a.exr", "-o", "a.txt"}, ".exr, .png or .jpg");
    CHECK(place.run({"tiny.xml", "other.xml", "--raw", "{scene}.raw.exr"}).code == 0);
    CHECK(place.has("other.raw.exr"));
    const Outcome missing = place.run({"tiny.xml", "--resume", "none.exr"});
    CHECK(missing.code == 1);
    CHECK(contains(missing.err, "none.exr"));
  }
}
