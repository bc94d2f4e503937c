#include "base/log.h"

#include <doctest/doctest.h>

#include "support/files.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("logs know nothing of each other") {
  const TemporaryDirectory folder;
  Log one, other;
  one.set_level(Log::Level::quiet);
  other.set_level(Log::Level::verbose);
  CHECK(one.level() == Log::Level::quiet);
  CHECK(other.level() == Log::Level::verbose);
  one.open_file(folder.path("one.log"));
  one.info("of {}", "one");
  CHECK(read_file(folder.path("one.log")).ends_with(" of one\n"));
  CHECK_THROWS_AS(other.open_file(folder.path("no/folder.log")), std::runtime_error);
}

TEST_CASE("a recording keeps errors and warnings while it exists") {
  Log log;
  log.set_level(Log::Level::quiet);
  {
    const Log::Recording recording(log);
    log.info("too small to be shown");
    log.warning("{} of the test of the log", "a warning");
    CHECK(recording.lines() ==
          std::vector<std::string>{"duet: warning: a warning of the test of the log"});
  }
  const Log::Recording recording(log);
  CHECK(recording.lines().empty());
}

TEST_CASE("who draws on the terminal is told before a message is shown, and only then") {
  Log log;
  log.set_level(Log::Level::quiet);
  int told = 0;
  log.set_before_write([&] { ++told; });
  log.info("not shown");
  CHECK(told == 0);
  log.write(Log::Level::quiet, "(a line of the test of the log)");
  CHECK(told == 1);
  log.set_before_write(nullptr);
  log.write(Log::Level::quiet, "(another one)");
  CHECK(told == 1);
}
