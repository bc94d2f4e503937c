// Folders, names that are wrong, and standard input in the place of a scene file.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include "app/workplace.h"
#include "support/show.h"

using namespace duet::test;

namespace {

Outcome run_with_input(const Workplace& place, const std::vector<std::string>& arguments,
                       const std::string& input) {
  return run_duet(arguments, {.directory = place.path(""), .input = input});
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("a folder stands for the scene in it, which has the folder's name") {
    const Workplace place;
    for (const char* folder : {"kitchen", "one", "several", "none"})
      std::filesystem::create_directory(place.path(folder));
    place.scene("kitchen/scene.xml");
    place.scene("kitchen/other.xml");
    place.scene("one/lamp.xml");
    place.scene("several/a.xml");
    place.scene("several/b.xml");
    CHECK(place.run({"kitchen", "one/"}).code == 0);
    CHECK(place.has("kitchen.exr"));
    CHECK(place.has("lamp.exr"));
    const Outcome here = run_duet({"."}, {.directory = place.path("kitchen")});
    CAPTURE(here.err);
    CHECK(here.code == 0);
    CHECK(place.has("kitchen/kitchen.exr"));
    CHECK(place.run({"info", "kitchen"}).code == 0);

    const Outcome several = place.run({"several"});
    CHECK(several.code == 1);
    CHECK(contains(several.err, "cannot read several: "));
    CHECK(contains(several.err, "a.xml, b.xml"));
    const Outcome none = place.run({"none"});
    CHECK(none.code == 1);
    CHECK(contains(none.err, "no .xml file"));
  }

  TEST_CASE("scenes that cannot be read have a reason") {
    const Workplace place;
    place.scene("kitchen.xml");
    place.write("empty.xml", "");
    place.write("binary.xml", std::string("\x7f"
                                          "ELF\0\1\1\1",
                                          8));
    mkfifo(place.path("pipe.xml").c_str(), 0600);
    const std::pair<const char*, const char*> cases[] = {
        {"kichen.xml",
         "cannot read kichen.xml: No such file or directory (did you mean "
         "\"kitchen.xml\"?)"},
        {"kitchen", "did you mean \"kitchen.xml\"?"},
        {"kitchen.xm", "did you mean \"kitchen.xml\"?"},
        {"nowhere/a.xml", "cannot read nowhere/a.xml: No such file or directory"},
        {"kitchen.xml/a.xml", "Not a directory"},
        {"empty.xml", "cannot read empty.xml: it is empty"},
        {"pipe.xml", "cannot read pipe.xml: it is not a regular file"},
        {"binary.xml", "binary.xml:1:1: error: this is not an XML file"},
    };
    for (const auto& [file, message] : cases)
      for (const std::vector<std::string>& arguments :
           {std::vector<std::string>{file}, {"info", file}}) {
        const Outcome o = place.run(arguments);
        SHOW(file);
        CAPTURE(o.err);
        CHECK(o.code == 1);
        CHECK(contains(o.err, message));
      }
    CHECK(!contains(place.run({"bath.xml"}).err, "did you mean"));
    place.write("includes.xml",
                "<scene version=\"3.0.0\">\n<include filename=\"pipe.xml\"/>\n</scene>");
    CHECK(contains(place.run({"includes.xml"}).err,
                   "includes.xml:2:10: error: cannot read "
                   "pipe.xml: it is not a regular file"));
  }

  TEST_CASE("a scene can come from standard input") {
    const Workplace place, elsewhere;
    TinyScene s;
    s.extra = "<include filename=\"part.xml\"/>";
    const std::string scene = elsewhere.scene("a.xml", s);
    // Files are looked for in the current directory.
    place.write("part.xml",
                "<scene version=\"3.0.0\"><default name=\"seen\" value=\"1\"/></scene>");
    const Outcome o = run_with_input(place, {"-", "--stats", "s.json", "-D", "spp=2"}, scene);
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(place.has("stdin.exr"));
    CHECK(contains(read_file(place.path("s.json")), "\"scene\": \"<stdin>\""));
    const Outcome info = run_with_input(place, {"info", "-", "-D", "seen=2"}, scene);
    CHECK(info.code == 0);
    CHECK(contains(info.out, "$seen = 2"));

    const std::string wrong =
        elsewhere.write("b.xml", "<scene version=\"3.0.0\">\n<shap/></scene>");
    CHECK(contains(run_with_input(place, {"-"}, wrong).err, "<stdin>:2:1: error: "));
    const Outcome empty = run_with_input(place, {"-"}, "/dev/null");
    CHECK(empty.code == 1);
    CHECK(contains(empty.err, "cannot read <stdin>: it is empty"));
    CHECK(run_with_input(place, {"-", "-"}, scene).code == 2);
    CHECK(run_with_input(place, {"-", "-o", "x{scene}.exr", "-", "part.xml"}, scene).code == 2);
    // A folder cannot be read.
    CHECK(contains(run_with_input(place, {"-"}, place.path("")).err, "cannot read <stdin>"));
  }

  TEST_CASE("the image of a scene from standard input is that of the file") {
    const Workplace place;
    place.scene("a.xml");
    CHECK(place.run({"a.xml"}).code == 0);
    CHECK(run_with_input(place, {"-"}, place.path("a.xml")).code == 0);
    const Outcome same = place.run({"compare", "a.exr", "stdin.exr", "--require", "rmse<1e-9"});
    CHECK(same.code == 0);
  }
}
