// Exit codes and what goes on when something goes wrong.
#include <doctest/doctest.h>

#include <csignal>

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
    CHECK(contains(o.err, "3 of 5 scenes failed"));
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
    for (const char* output : {"nowhere/out.exr", "/dev/null/out.exr", "tiny.xml/out.exr"}) {
      const Outcome o = place.run({"tiny.xml", "-o", output, "--spp", "1000000000"});
      CAPTURE(o.err);
      CHECK(o.code == 1);
      CHECK(contains(o.err, "cannot write"));
    }
    CHECK(place.run({"tiny.xml", "-o", "dir.exr"}).code == 0);  // a directory like any other
    CHECK(place.has("dir.exr/tiny.exr"));
  }

  TEST_CASE("an image that cannot be written is saved elsewhere") {
    const Workplace place, refuge;
    place.scene();
    std::filesystem::create_directory(place.path("out"));
    Process duet({"tiny.xml", "-o", "out/image.png", "--time", "1h", "--progress", "bar"},
                 {.directory = place.path(""), .environment = {{"TMPDIR", refuge.path("")}}});
    REQUIRE(duet.wait_for_message("error", 120));  // some passes are done
    std::filesystem::remove_all(place.path("out"));
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
