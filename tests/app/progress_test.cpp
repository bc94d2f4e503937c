// What is shown while a batch is rendered.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/ioctl.h>

#include <csignal>
#include <cstdlib>
#include <regex>

#include "app/workplace.h"

using namespace duet::test;

namespace {

/// Everything that a terminal of so many columns was sent.
std::string shown_on_terminal(const Workplace& place, std::vector<std::string> arguments,
                              unsigned short width) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  REQUIRE(terminal >= 0);
  REQUIRE(grantpt(terminal) == 0);
  REQUIRE(unlockpt(terminal) == 0);
  const winsize size{25, width, 0, 0};
  ioctl(terminal, TIOCSWINSZ, &size);
  Process duet(arguments, {.directory = place.path(""), .errors = ptsname(terminal)});
  std::string text;
  // Reading fails once the program has closed the other end.
  char block[4096];
  for (ssize_t n = 0; (n = read(terminal, block, sizeof block)) > 0;) text.append(block, size_t(n));
  close(terminal);
  CHECK(duet.wait(60).code == 0);
  return text;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the bar of a batch says which scene it is and when all are done") {
    const Workplace place;
    place.scene("kitchen.xml", endless_scene());
    place.scene("bath.xml", endless_scene());
    for (const unsigned short width : {50, 80, 160}) {
      const std::string text =
          shown_on_terminal(place, {"kitchen.xml", "bath.xml", "--time", "0.8", "-t", "2"}, width);
      CAPTURE(text);
      const std::regex first(
          R"(\[1/2\] kitchen (\[#*\.*\])? +\d+ % .*[\d.]+ s left \(all: [\d.]+ s\))");
      const std::regex second(R"(\[2/2\] bath (\[#+\.*\])? +\d+ % .*left \(all: [\d.]+ s\))");
      CHECK(std::regex_search(text, first));
      CHECK(std::regex_search(text, second));
      // Lines that are drawn again must not be broken in two.
      std::smatch bar;
      for (std::string rest = text; std::regex_search(rest, bar, std::regex("\x1b\\[K([^\r\n]*)"));
           rest = bar.suffix())
        if (contains(bar[1], " left")) CHECK(bar[1].str().size() < width);
      CHECK(contains(text, ".]") == (width > 50));
      CHECK(contains(text, "Msamples/s") == (width == 160));
      CHECK(contains(text, "[2/2] bath.xml: "));
    }
  }

  TEST_CASE("the time that a batch takes is that of its scenes") {
    const Workplace place;
    for (const char* name : {"a.xml", "b.xml", "c.xml"}) place.scene(name, endless_scene());
    const std::string text =
        shown_on_terminal(place, {"a.xml", "b.xml", "c.xml", "--time", "1", "-t", "2"}, 80);
    CAPTURE(text);
    const auto times = [&](const std::string& label) {
      std::vector<double> all;
      const std::regex pattern("\\" + label + R"( \w [^\r]*\(all: ([\d.]+) s\))");
      for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
        all.push_back(std::stod((*i)[1]));
      return all;
    };
    const auto first = times("[1/3]"), second = times("[2/3]"), third = times("[3/3]");
    REQUIRE(first.size() > 1);
    REQUIRE(second.size() > 1);
    REQUIRE(third.size() > 1);
    // Two more scenes of a second or, on a busy machine, somewhat more; one more; none.
    CHECK(first.back() > 1.5);
    CHECK(first.back() < 5);
    CHECK(second.back() > 0.8);
    CHECK(second.back() < 0.75 * first.back());
    CHECK(third.back() < 0.75 * second.back());
  }

  TEST_CASE("lines of a batch say the same") {
    const Workplace place;
    place.scene("a.xml", endless_scene());
    place.scene("b.xml", endless_scene());
    Process duet({"a.xml", "b.xml", "--time", "1h"}, {.directory = place.path("")});
    REQUIRE(duet.wait_for_message("(all: ", 60));
    duet.send(SIGTERM);
    const Outcome o = duet.wait(60);
    CAPTURE(o.err);
    CHECK(
        std::regex_search(o.err, std::regex(R"(\[1/2\] a: \d+ %, [0-9.]+ spp, .* left \(all: )")));
  }
}
