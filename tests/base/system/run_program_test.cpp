#include "base/system/run_program.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace duet;

TEST_CASE("a program's streams are kept apart, and its end is told") {
  const ProgramEnd good = run_program({"sh", "-c", "echo one; echo two >&2; cat"});
  CHECK(good.exit_code == 0);
  CHECK(good.out == "one\n");
  CHECK(good.err == "two\n");
  CHECK(run_program({"sh", "-c", "exit 3"}).exit_code == 3);
  CHECK(run_program({"sh", "-c", "kill -TERM $$"}).exit_code == 143);
}

TEST_CASE("more than a megabyte of a program's output is read, and not kept") {
  const ProgramEnd end =
      run_program({"sh", "-c", "head -c 3000000 /dev/zero; head -c 2000000 /dev/zero >&2"});
  CHECK(end.exit_code == 0);
  CHECK(end.out.size() == size_t(1) << 20);
  CHECK(end.err.size() == size_t(1) << 20);
}

TEST_CASE("programs that are not there are found out") {
  CHECK(find_program("no-such-program-anywhere").empty());
  CHECK(find_program("sh").ends_with("/sh"));
  CHECK_THROWS_AS(run_program({"no-such-program-anywhere"}), std::runtime_error);
}
