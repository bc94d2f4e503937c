// What happens around the program must not stop a render: full disks, closed streams, odd names.
#include <doctest/doctest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "image/image_facts.h"

using namespace duet;
using namespace duet::test;

TEST_SUITE("program") {
  TEST_CASE("a log that cannot be written is one warning") {
    const Workplace place;
    place.scene();
    const Outcome o = place.run({"tiny.xml", "-v", "--log", "/dev/full"});
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(place.has("tiny.exr"));
    const std::string warning = "the log /dev/full cannot be written";
    CHECK(contains(o.err, warning));
    CHECK(o.err.find(warning) == o.err.rfind(warning));
    CHECK(place.run({"tiny.xml", "--log", "/dev/null/log.txt"}).code == 2);
  }

  TEST_CASE("a log may be a pipe, if somebody reads it") {
    const Workplace place;
    place.scene();
    const std::string pipe = place.path("pipe");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const Outcome unread = place.run({"tiny.xml", "--log", "pipe"});
    CHECK(unread.code == 2);
    CHECK(contains(unread.err, "--log: pipe: nobody reads this pipe"));
    CHECK(!place.has("tiny.exr"));
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    CHECK(place.run({"tiny.xml", "--log", "pipe"}).code == 0);
    char text[4096];
    const ssize_t size = read(reader, text, sizeof text);
    close(reader);
    CHECK(contains(std::string(text, size_t(std::max<ssize_t>(size, 0))), "tiny.exr"));
  }

  TEST_CASE("streams that are closed do not get into images") {
    const Workplace place;
    place.scene();
    TinyScene warns;
    warns.extra = "<emitter type=\"constant\"><float name=\"brightnes\" value=\"1\"/></emitter>";
    place.scene("warns.xml", warns);
    REQUIRE(place.run({"warns.xml", "-o", "expected.exr"}).code == 0);
    for (const std::vector<int>& closed :
         {std::vector{STDERR_FILENO}, {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}}) {
      const Outcome o = run_duet({"warns.xml", "-v", "-o", "a.exr", "--log", "log.txt"},
                                 {.directory = place.path(""), .closed = closed});
      CHECK(o.code == 0);
      CHECK(read_image_facts(place.path("a.exr")).is_complete);
      // The log has lines with the time before them, and no others.
      for (size_t at = 0; at < read_file(place.path("log.txt")).size();) {
        const std::string log = read_file(place.path("log.txt"));
        CHECK(log.substr(at, 2) == "20");
        at = log.find('\n', at) + 1;
      }
      std::filesystem::remove(place.path("a.exr"));
    }
  }

  TEST_CASE("a reader of messages that has gone does not end the render") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    // Nobody reads this pipe any more.
    const std::string pipe = place.path("pipe");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    Process duet({"endless.xml", "--time", "1s", "-v", "--log", pipe},
                 {.directory = place.path("")});
    REQUIRE(duet.wait_for_message("built in", 300));
    close(reader);
    const Outcome o = duet.wait(300);
    CHECK(o.code == 0);
    CHECK(place.has("endless.exr"));
  }

  TEST_CASE("names that are not UTF-8 are names") {
    const Workplace place;
    const std::string name = "caf\xe9.xml";
    place.scene(name);
    const Outcome o = place.run(
        {name, "missing-\xff.xml", "-o", "{scene}.exr", "-o", "{scene}.png", "--stats", "s.json"});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(place.has("caf\xe9.exr"));
    CHECK(place.has("caf\xe9.png"));
    const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
    CHECK(stats[0]["spp"] == 4);
    CHECK(stats[1]["failed"] == true);
    CHECK(contains(place.run({name, "-x", "-o", "{scene}.exr"}).err, "skipped"));
    CHECK(place.run({"info", name}).code == 0);
    CHECK(place.run({"compare", "caf\xe9.exr", "caf\xe9.exr", "--json"}).code != 134);
  }

  TEST_CASE("scenes that fail are in the statistics, with the reasons") {
    const Workplace place;
    place.scene("a.xml");
    place.write("bad.xml", "<scene version=\"3.0.0\">\n  <shape type=\"spere\"/>\n</scene>");
    CHECK(place.run({"bad.xml", "a.xml", "missing.xml", "--stats", "s.json"}).code == 1);
    auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
    REQUIRE(stats.size() == 3);
    CHECK(stats[0]["scene"] == "bad.xml");
    CHECK(stats[0]["failed"] == true);
    CHECK(contains(stats[0]["messages"].dump(), "bad.xml:2:"));
    CHECK(stats[1]["spp"] == 4);
    CHECK(!stats[1].contains("failed"));
    CHECK(stats[2]["failed"] == true);
    CHECK(contains(stats[2]["messages"].dump(), "missing.xml"));
    CHECK(!contains(stats[2]["messages"].dump(), "bad.xml"));
    // One scene is an object, not a list.
    CHECK(place.run({"bad.xml", "--stats", "s.json"}).code == 1);
    stats = nlohmann::json::parse(read_file(place.path("s.json")));
    CHECK(stats["failed"] == true);
  }

  TEST_CASE("statistics that cannot be written are an error beside the image") {
    const Workplace place, other;
    place.scene();
    Process later({"tiny.xml", "--time", "2s", "-v", "--stats", other.path("gone/s.json")},
                  {.directory = place.path("")});
    REQUIRE(later.wait_for_message("built in", 300));
    std::filesystem::remove_all(other.path("gone"));
    other.write("gone", "a file now");
    const Outcome o = later.wait(300);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "--stats: "));
    CHECK(place.has("tiny.exr"));
  }

  TEST_CASE("a place for rescued images that does not exist is a message") {
    const Workplace place;
    place.scene();
    place.write("tiny.exr", "old");
    const Outcome o = run_duet(
        {"tiny.xml"},
        {.directory = place.path(""), .environment = {{"TMPDIR", "/nowhere"}}, .file_limit = 512});
    CAPTURE(o.err);
    CHECK(o.code == 1);
    CHECK(contains(o.err, "tiny.exr cannot be written"));
    CHECK(contains(o.err, "nor could it be saved"));
  }
}
