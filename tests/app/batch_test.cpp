// Exit codes and what goes on when something goes wrong.
#include <doctest/doctest.h>
#include <sched.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "app/workplace.h"

using namespace duet::test;

TEST_SUITE("program") {
  TEST_CASE("one bad scene does not stop the others") {
    const Workplace place;
    place.scene("a.xml");
    place.write("bad.xml", "<scene version=\"3.0.0\">\n  <shape type=\"spere\"/>\n</scene>");
    place.write("cut.xml", TinyScene().text().substr(0, 400));
    place.scene("z.xml");
    const Outcome o = place.run({"a.xml", "bad.xml", "cut.xml", "missing.xml", "z.xml"});
    CHECK(o.code == 1);
    CHECK(place.has("a.exr"));
    CHECK(place.has("z.exr"));
    CHECK(place.count() == 6);
    CHECK(contains(o.err, "bad.xml:2:"));
    CHECK(contains(o.err, "did you mean \"sphere\"?"));
    CHECK(contains(o.err, "cut.xml:"));
    CHECK(contains(o.err, "missing.xml"));
    const std::string summary = o.err.substr(std::min(o.err.size(), o.err.find("3 of 5 scenes")));
    CHECK(contains(summary, "3 of 5 scenes failed:\n  bad.xml:2:10: unknown shape type \"spere\""));
    CHECK(contains(summary, "\n  cut.xml:"));
    CHECK(contains(summary, "\n  missing.xml: No such file or directory"));
    CHECK(std::count(summary.begin(), summary.end(), '\n') == 4);
    CHECK(place.run({"missing.xml"}).code == 1);
  }

  TEST_CASE("a batch can stop at the first failure") {
    const Workplace place;
    place.write("bad.xml", "<scene/>");
    place.scene("z.xml");
    const Outcome o = place.run({"bad.xml", "z.xml", "--no-keep-going"});
    CHECK(o.code == 1);
    CHECK(!place.has("z.exr"));
    CHECK(contains(o.err, "1 of 2 scenes were not tried"));
  }

  TEST_CASE("what only some scenes lack is a failure of those") {
    const Workplace place;
    place.scene("one.xml");
    TinyScene s;
    s.extra =
        "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" "
        "value=\"8\"/><integer name=\"height\" value=\"8\"/></film></sensor>";
    place.scene("two.xml", s);
    CHECK(place.run({"one.xml", "two.xml", "-s", "1"}).code == 1);
    CHECK(place.has("two.exr"));
    CHECK(place.run({"one.xml", "two.xml", "-s", "2"}).code == 2);
    // A definition that one of the scenes uses is fine.
    TinyScene named;
    named.extra = "<default name=\"only_here\" value=\"1\"/>";
    place.scene("named.xml", named);
    CHECK(place.run({"one.xml", "named.xml", "-D", "only_here=2"}).code == 0);
  }

  TEST_CASE("warnings are errors if asked to") {
    const Workplace place;
    TinyScene s;
    s.extra = "<emitter type=\"constant\"><float name=\"brightnes\" value=\"1\"/></emitter>";
    place.scene("warns.xml", s);
    const Outcome o = place.run({"warns.xml"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "warning"));
    std::filesystem::remove(place.path("warns.exr"));
    const Outcome strict = place.run({"warns.xml", "--strict"});
    CHECK(strict.code == 1);
    CHECK(contains(strict.err, "--strict"));
    CHECK(!place.has("warns.exr"));
    CHECK(place.run({"info", "warns.xml"}).code == 0);
    CHECK(place.run({"info", "warns.xml", "--strict"}).code == 1);
    // Warnings of the program count, too.
    TinyScene sampler;
    std::string text = sampler.text();
    text.replace(text.find("independent"), 11, "multijitter");
    place.write("sampler.xml", text);
    CHECK(place.run({"sampler.xml", "--strict-sampler"}).code == 0);
    CHECK(place.run({"sampler.xml", "--strict"}).code == 0);
    CHECK(place.run({"sampler.xml", "--strict-sampler", "--strict"}).code == 1);
  }

  TEST_CASE("places where no image can be are found out before rendering") {
    const Workplace place;
    place.scene();
    std::filesystem::create_directory(place.path("dir.exr"));
    for (const char* output : {"/dev/null/out.exr", "tiny.xml/out.exr", "tiny.xml/a/out.exr"}) {
      const Outcome o = place.run({"tiny.xml", "-o", output, "--spp", "1000000000"});
      CAPTURE(o.err);
      CHECK(o.code == 1);
      CHECK(contains(o.err, "cannot write"));
    }
    // A name that is too long for the file system, and for a rescued image.
    const std::string long_name(250, 'x');
    const Outcome o =
        place.run({"tiny.xml", "-o", long_name + ".exrexr.exr", "--spp", "1000000000"});
    CHECK(o.code == 1);
    CHECK(contains(o.err, ": its name is too long"));
    CHECK(place.run({"tiny.xml", "-o", "dir.exr"}).code == 0);  // a directory like any other
    CHECK(place.has("dir.exr/tiny.exr"));
  }

  TEST_CASE("formats that no image can be written in are found out before rendering") {
    const Workplace place;
    place.scene();
    const Outcome wide =
        place.run({"tiny.xml", "-o", "a.jpg", "--size", "65501x1", "--spp", "1000000000"});
    CAPTURE(wide.err);
    CHECK(wide.code == 1);
    CHECK(contains(wide.err, "a.jpg cannot be written: JPEG has at most 65500 pixels a side"));
    CHECK(place.count() == 1);
  }

  TEST_CASE("display images need no module for image formats") {
    const Workplace place;
    place.scene();
    const Outcome o = run_duet({"tiny.xml", "-o", "a.png", "-o", "a.jpg"},
                               {.directory = place.path(""),
                                .environment = {{"DUET_IMAGE_MODULE", place.path("none.so")}}});
    CHECK(o.code == 0);
    CHECK(place.has("a.png"));
    CHECK(place.has("a.jpg"));
  }

  TEST_CASE("directories of output files are made") {
    const Workplace place;
    place.scene();
    const Outcome o =
        place.run({"tiny.xml", "-o", "a/b/out.exr", "-o", "{spp}/{scene}/", "-o", "c/d/", "--time",
                   "0.2", "--stats", "s/stats.json", "--log", "l/m/log.txt"});
    CAPTURE(o.err);
    CHECK(o.code == 0);
    for (const char* file : {"a/b/out.exr", "c/d/tiny.exr", "s/stats.json", "l/m/log.txt"}) {
      CAPTURE(file);
      CHECK(place.has(file));
    }
    CHECK(contains(o.err, "/tiny/tiny.exr"));
    CHECK(place.run({"compare", "a/b/out.exr", "c/d/tiny.exr", "--html", "h/i.html"}).code == 0);
    CHECK(place.has("h/i.html"));
    // Not for what is a slip of the pen, nor for a scene that cannot be read.
    const Outcome slip = place.run({"tiny.xml", "-o", "new/out"});
    CHECK(slip.code == 2);
    CHECK(contains(slip.err, "ends with /"));
    CHECK(place.run({"missing.xml", "-o", "new/out.exr"}).code == 1);
    CHECK(!place.has("new"));
  }

  TEST_CASE("a scene called scene.xml has the name of its folder") {
    const Workplace place;
    for (const char* folder : {"kitchen", "bath"}) {
      std::filesystem::create_directory(place.path(folder));
      place.scene(std::string(folder) + "/scene.xml");
    }
    place.scene("kitchen/scene_v3.xml");
    CHECK(place.run({"kitchen/scene.xml", "bath/scene.xml", "kitchen/scene_v3.xml"}).code == 0);
    CHECK(place.has("kitchen.exr"));
    CHECK(place.has("bath.exr"));
    CHECK(place.has("scene_v3.exr"));
    CHECK(place.run({"kitchen/scene.xml", "bath", "-o", "{folder}-{scene}.png"}).code == 0);
    CHECK(place.has("kitchen-kitchen.png"));
    CHECK(place.has("bath-bath.png"));
    CHECK(run_duet({"scene.xml"}, {.directory = place.path("bath")}).code == 0);
    CHECK(place.has("bath/bath.exr"));
    CHECK(place.run({"kitchen/scene.xml", "bath/../kitchen/scene.xml"}).code == 2);
  }

  TEST_CASE("more threads than processors are no reason for a warning") {
    const Workplace place;
    place.scene();
    cpu_set_t all, one;
    REQUIRE(sched_getaffinity(0, sizeof all, &all) == 0);
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
      if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
    for (const cpu_set_t* processors : {&all, &one}) {
      sched_setaffinity(0, sizeof *processors, processors);
      for (const char* threads : {"1", "2", "8", "64"}) {
        const Outcome o = place.run({"tiny.xml", "-q", "-t", threads});
        CAPTURE(threads);
        CHECK(o.code == 0);
        CHECK(o.err == "");
      }
    }
    sched_setaffinity(0, sizeof all, &all);
  }

  TEST_CASE("an image that cannot be written is saved elsewhere") {
    const Workplace place, refuge;
    place.scene();
    std::filesystem::create_directory(place.path("out"));
    Process duet({"tiny.xml", "-o", "out/image.png", "--time", "1h", "--progress", "bar"},
                 {.directory = place.path(""), .environment = {{"TMPDIR", refuge.path("")}}});
    REQUIRE(duet.wait_for_message("error", 120));  // some passes are done
    std::filesystem::remove_all(place.path("out"));
    place.write("out", "a file now");
    duet.send(SIGINT);
    const Outcome o = duet.wait(120);
    CAPTURE(o.err);
    CHECK(o.code == 130);
    CHECK(contains(o.err, "the image is saved as " + refuge.path("duet-image")));
    REQUIRE(refuge.count() == 1);
  }

  TEST_CASE("a full disk leaves no half file and keeps the old one") {
    const Workplace place;
    place.scene();
    place.write("tiny.exr", "old");
    const Outcome o = run_duet({"tiny.xml"}, {.directory = place.path(""),
                                              .environment = {{"TMPDIR", place.path("")}},
                                              .file_limit = 512});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "tiny.exr cannot be written"));
    CHECK(contains(o.err, "nor could it be saved"));
    CHECK(read_file(place.path("tiny.exr")) == "old");
    CHECK(place.count() == 2);
  }

  TEST_CASE("an image too large for the machine is refused") {
    const Workplace place;
    place.scene();
    const Outcome o = place.run({"tiny.xml", "--size", "65536x65536", "--target-error", "1%"});
    CHECK(o.code == 1);
    CHECK(contains(o.err, "GB of memory"));
    CHECK(o.seconds < 5);
    // A window of it is not.
    CHECK(place.run({"tiny.xml", "--size", "65536x65536", "--crop", "30000,30000,8,8"}).code == 0);
  }

  TEST_CASE("messages also go to the log") {
    const Workplace place;
    place.scene();
    CHECK(place.run({"tiny.xml", "-q", "--log", "log.txt"}).err.empty());
    const std::string log = read_file(place.path("log.txt"));
    CHECK(contains(log, "tiny.exr"));
    const Outcome verbose = place.run({"tiny.xml", "-v"});
    CHECK(contains(verbose.err, "1 point light"));
    CHECK(contains(verbose.err, "built in"));
  }
}
