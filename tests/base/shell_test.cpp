#include "base/shell.h"

#include <doctest/doctest.h>

#include "base/system/run_program.h"

using namespace duet;

TEST_CASE("a shell reads quoted arguments as they were") {
  const std::vector<std::string> arguments{"plain-1.0/x,y:z@%", "",     "two words", "it's",
                                           "\"$HOME\" `id`",    "a\nb", "{1..3}*?~", "\\'\\"};
  const ProgramEnd end = run_program({"sh", "-c", "printf '%s|' " + shell_quoted(arguments)});
  std::string expected;
  for (const std::string& a : arguments) expected += a + "|";
  CHECK(end.out == expected);
  CHECK(shell_quoted("plain-1.0/x,y:z@%") == "plain-1.0/x,y:z@%");
}
