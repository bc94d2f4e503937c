// Images on standard output.
#include <doctest/doctest.h>
#include <fcntl.h>

#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/workplace.h"

using namespace duet::test;

TEST_SUITE("program") {
  TEST_CASE("standard output gets the image and nothing else") {
    const Workplace place;
    place.scene();
    const std::pair<std::vector<std::string>, std::string> formats[] = {
        {{}, "\x76\x2f\x31\x01"},
        {{"--format", "exr"}, "\x76\x2f\x31\x01"},
        {{"--format", "png"}, "\x89PNG"},
        {{"--format", "jpg"}, "\xff\xd8\xff"},
    };
    for (const auto& [options, mark] : formats) {
      std::vector<std::string> arguments{"tiny.xml", "-v", "-o", "-"};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const Outcome o = place.run(arguments);
      CAPTURE(o.err);
      CHECK(o.code == 0);
      CHECK(o.out.substr(0, mark.size()) == mark);
      CHECK(place.count() == 1);
    }
    const Outcome o = place.run({"tiny.xml", "-o", "-", "-o", "file.exr", "--format", "png"});
    CAPTURE(o.err);
    CHECK(o.code == 2);  // two formats
    CHECK(place.run({"tiny.xml", "-o", "-", "-o", "file.exr"}).code == 0);
    place.write("out.exr", place.run({"tiny.xml", "-o", "-"}).out);
    CHECK(place.run({"compare", "out.exr", "file.exr", "--require", "rmse<1e-9"}).code == 0);
  }

  TEST_CASE("the format holds where the name says none") {
    const Workplace place;
    place.scene();
    CHECK(place.run({"tiny.xml", "--format", "png"}).code == 0);
    CHECK(place.has("tiny.png"));
    CHECK(place.run({"tiny.xml", "--format", "jpg", "-o", "out/"}).code == 0);
    CHECK(place.has("out/tiny.jpg"));
    CHECK(place.run({"tiny.xml", "--format", "png", "-o", "a.png"}).code == 0);
    CHECK(place.run({"tiny.xml", "--format", "jpg", "-o", "a.JPEG"}).code == 0);
    CHECK(place.run({"tiny.xml", "--format", "jpg", "-o", "a.png"}).code == 2);
    CHECK(place.run({"tiny.xml", "--format", "bmp"}).code == 2);
  }

  TEST_CASE("what cannot go to standard output is refused") {
    const Workplace place;
    place.scene("a.xml");
    place.scene("b.xml");
    CHECK(place.run({"a.xml", "b.xml", "-o", "-"}).code == 2);
    CHECK(place.run({"a.xml", "-o", "-", "-o", "-"}).code == 2);
    CHECK(place.run({"a.xml", "-x", "-o", "-"}).code == 2);
    // A terminal would get binary data.
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    REQUIRE(terminal >= 0);
    REQUIRE(grantpt(terminal) == 0);
    REQUIRE(unlockpt(terminal) == 0);
    const Outcome o =
        run_duet({"a.xml", "-o", "-"}, {.directory = place.path(""), .output = ptsname(terminal)});
    close(terminal);
    CHECK(o.code == 2);
    CHECK(contains(o.err, "terminal"));
  }

  TEST_CASE("an image that standard output does not take is saved elsewhere") {
    const Workplace place, refuge;
    place.scene();
    const Outcome o =
        run_duet({"tiny.xml", "-o", "-"}, {.directory = place.path(""),
                                           .environment = {{"TMPDIR", refuge.path("")}},
                                           .output = "/dev/full"});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "standard output cannot be written: No space left on device"));
    CHECK(contains(o.err, "the image is saved as " + refuge.path("duet-stdout")));
    CHECK(refuge.count() == 1);
  }

  TEST_CASE("a reader that goes away ends nothing but the writing") {
    const Workplace place, refuge;
    place.scene();
    mkfifo(place.path("pipe").c_str(), 0600);
    // Both ends open at once, so that neither waits for the other.
    const int reader = open(place.path("pipe").c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(reader >= 0);
    Process duet({"tiny.xml", "-o", "-", "--time", "1"},
                 {.directory = place.path(""),
                  .environment = {{"TMPDIR", refuge.path("")}},
                  .output = place.path("pipe")});
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    close(reader);
    const Outcome o = duet.wait(120);
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "Broken pipe"));
    CHECK(refuge.count() == 1);
  }
}
