// Messages about scenes: of one kind, and about values of the command line.
#include <doctest/doctest.h>

#include "support/memory_scene.h"
#include "support/texts.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string summary(const Diagnostics& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics.summary()) all += d.to_string() + "\n";
  return all;
}

}  // namespace

TEST_CASE("warnings that differ by their place alone are one, with a count") {
  const auto file = std::make_shared<const std::string>("a.xml");
  Diagnostics d;
  d.warning({file, 3, 1}, "odd");
  d.error({file, 4, 1}, "bad");
  d.warning({file, 5, 1}, "odd");
  d.warning({file, 6, 1}, "even");
  d.error({file, 7, 1}, "bad");
  d.warning({file, 5, 1}, "odd");  // the same once more
  d.warning({file, 8, 1}, "odd");
  CHECK(summary(d) ==
        "a.xml:3:1: warning: odd (3 times)\na.xml:4:1: error: bad\na.xml:6:1: warning: even\n"
        "a.xml:7:1: error: bad\n");
  CHECK(d.all().size() == 6);
  CHECK(d.error_count() == 2);
}

TEST_CASE("a scene with thousands of warnings of one kind says how many, and others as well") {
  std::string content;
  for (int i = 0; i < 3000; ++i)
    content += "<shape type='sphere'><float name='odd' value='1'/></shape>\n";
  content += "<shape type='cube'><float name='even' value='1'/></shape>";
  const ReadResult r = read_scene("3.0.0", content);
  REQUIRE(r.scene);
  CHECK(r.diagnostics.all().size() == 3001);
  const std::string text = summary(r.diagnostics);
  CHECK(text.find("\"odd\" of <shape type=\"sphere\"> (3000 times)\n") != text.npos);
  CHECK(text.find("\"even\"") != text.npos);
  CHECK(occurrences(text, "\n") == 2);
}

TEST_CASE("of a hundred kinds of warnings and more the rest is counted") {
  std::string content;
  for (int i = 0; i < 150; ++i)
    content +=
        "<shape type='sphere'><float name='odd" + std::to_string(i) + "' value='1'/></shape>\n";
  const std::string text = summary(read_scene("3.0.0", content).diagnostics);
  CHECK(occurrences(text, "unused parameter") == 100);
  CHECK(text.find("and 50 more warnings") != text.npos);
}

TEST_CASE("errors about a value of the command line point to it") {
  const auto read = [](const std::string& content, const std::string& value) {
    return read_text(scene_text("3.0.0", "<default name='v' value='1'/>" + content), {},
                     {{"v", value}});
  };
  const auto fails = [&](const std::string& content, const std::string& value,
                         const std::string& message) {
    const ReadResult r = read(content, value);
    INFO(r.messages());
    CHECK(!r.scene);
    CHECK(r.has("-D v=" + value + " (/scene/scene.xml:2:"));
    return r.has(message);
  };
  const std::string ball = "<shape type='sphere'><float name='radius' value='$v'/></shape>";
  CHECK(read(ball, "2").messages() == "");
  CHECK(fails(ball, "two", ": error: \"two\" is not a finite number"));
  CHECK(fails(ball, "0", ": error: the parameter \"radius\""));
  CHECK(fails("<shape type='$v'/>", "ball", ": error: unknown shape type \"ball\""));
  CHECK(fails("<shape type='obj'><string name='filename' value='a$v.obj'/></shape>", "9",
              ": error: file \"a9.obj\" not found"));
  CHECK(fails("<shape type='sphere'><transform name='to_world'><scale x='$v'/></transform></shape>",
              "0", ": error: a scale of zero"));
  CHECK(fails("<emitter type='point'><point name='position' x='0' y='$v' z='0'/></emitter>", "up",
              ": error: \"up\" is not a number"));
  CHECK(fails("<shape type='sphere'><ref id='$v'/></shape>", "red", ": error: nothing has the id"));
  // By way of another parameter, too.
  CHECK(fails("<default name='w' value='$v'/><shape type='$w'/>", "ball",
              ": error: unknown shape type \"ball\""));
  // What the scene says itself has its place there.
  CHECK(read("<default name='x' value='two'/><shape type='sphere'><float name='radius' value='$x'/>"
             "</shape>",
             "1")
            .has("/scene/scene.xml:2:"));
}
