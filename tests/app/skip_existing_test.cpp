// Which images --skip-existing takes as done.
#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>

#include "app/workplace.h"
#include "support/show.h"

using namespace duet::test;

TEST_SUITE("program") {
  TEST_CASE("finished images of the same settings are skipped") {
    const Workplace place;
    place.scene("a.xml");
    place.scene("b.xml");
    const Arguments outputs{"-o", "{scene}.exr", "-o", "{scene}.png", "-o", "{scene}.jpg"};
    REQUIRE(place.run(Arguments{"a.xml"} + outputs).code == 0);
    const std::string before = read_file(place.path("a.exr"));
    const Outcome o = place.run(Arguments{"a.xml", "b.xml", "-x", "-t", "1"} + outputs);
    CHECK(o.code == 0);
    CHECK(contains(o.err, "a.xml: skipped"));
    CHECK(read_file(place.path("a.exr")) == before);
    CHECK(place.has("b.exr"));
    CHECK(contains(place.run(Arguments{"a.xml", "-x", "--spp", "4"} + outputs).err, "skipped"));
  }

  TEST_CASE("an image whose raw film is gone is rendered again") {
    const Workplace place;
    place.scene("a.xml");
    place.write("jobs.csv", "scene,output,raw\na.xml,a.exr,film.exr\n");
    const Arguments arguments{"a.xml", "-x", "-o", "a.exr", "--raw", "film.exr"};
    REQUIRE(place.run(arguments).code == 0);
    CHECK(contains(place.run(arguments).err, "skipped"));
    std::filesystem::remove(place.path("film.exr"));
    CHECK(contains(place.run(arguments).err, "film.exr is not there: it is rendered again"));
    CHECK(place.has("film.exr"));
    CHECK(contains(place.run({"batch", "jobs.csv"}).out, "1 kept"));
    std::filesystem::remove(place.path("film.exr"));
    CHECK(contains(place.run({"batch", "jobs.csv"}).out, "1 rendered"));
    CHECK(place.has("film.exr"));
  }

  TEST_CASE("images that are not whole are rendered again") {
    const Workplace place;
    place.scene("a.xml");
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
      CAPTURE(name);
      const Arguments arguments{"a.xml", "-x", "-o", name};
      REQUIRE(place.run(arguments).code == 0);
      const std::string whole = read_file(place.path(name));
      CHECK(contains(place.run(arguments).err, "skipped"));
      const auto rendered_again = [&](const std::string& bytes, const std::string& why) {
        place.write(name, bytes);
        const Outcome o = place.run(arguments);
        CAPTURE(o.err);
        CHECK(contains(o.err, std::string(name) + " is rendered again: " + why));
        CHECK(contains(o.err, "4 spp"));
        CHECK(read_file(place.path(name)).size() > bytes.size() / 2);
      };
      rendered_again("", "it is empty");
      rendered_again("mine", "it cannot be read");
      rendered_again(whole.substr(0, whole.size() - 1), "it has been cut off");
      rendered_again(whole.substr(0, whole.size() - 40), "it has been cut off");
      rendered_again(whole.substr(0, 100), "it ");
    }
  }

  TEST_CASE("images of other settings are rendered again") {
    const Workplace place;
    TinyScene s;
    s.extra =
        "<include filename=\"part.xml\"/><shape type=\"obj\"><string name=\"filename\" "
        "value=\"mesh.obj\"/></shape><shape type=\"sphere\"><bsdf type=\"diffuse\">"
        "<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
        "value=\"t.png\"/></texture></bsdf></shape>";
    place.scene("a.xml", s);
    place.scene("plain.xml");
    const std::string part = "<scene version=\"3.0.0\"><emitter type=\"constant\"/></scene>";
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    place.write("part.xml", part);
    place.write("mesh.obj", mesh);
    REQUIRE(place.run({"plain.xml", "-o", "t.png"}).code == 0);
    REQUIRE(place.run({"plain.xml", "-o", "other.png", "--exposure", "1"}).code == 0);
    const Arguments arguments{"a.xml", "-x", "-o", "a.exr", "-o", "a.png"};
    REQUIRE(place.run(arguments).code == 0);
    const auto is_skipped = [&](const Arguments& more) {
      const Outcome o = place.run(arguments + more);
      CAPTURE(o.err);
      REQUIRE(o.code == 0);
      return contains(o.err, "skipped") && !contains(o.err, "again");
    };
    CHECK(is_skipped({}));
    for (const Arguments& more : {Arguments{"--spp", "5"},
                                  {"--seed", "3"},
                                  {"-D", "spp=6"},
                                  {"-i", "direct"},
                                  {"-I", "max_depth=3"},
                                  {"--size", "8x8"},
                                  {"--crop", "1,1,4,4"},
                                  {"--aov", "depth"},
                                  {"--strict-sampler"},
                                  {"--time", "0.01"},
                                  {"--target-error", "50%"}}) {
      CAPTURE(more[0]);
      CHECK(!is_skipped(more));
      CHECK(is_skipped(more));
      CHECK(!is_skipped({}));
    }
    // Exposure is for display alone.
    const Outcome brighter = place.run(arguments + Arguments{"--exposure", "1"});
    CHECK(contains(brighter.err, "a.png is rendered again"));
    CHECK(!contains(brighter.err, "a.exr is rendered again"));
    CHECK(!is_skipped({}));
    // The form of a kind of file concerns that kind alone.
    for (const auto& [options, changed, kept] :
         {std::tuple<Arguments, const char*, const char*>{{"--png-depth", "16"}, "a.png", "a.exr"},
          {{"--aov-names", "blender"}, "a.exr", "a.png"},
          {{"--exr-parts"}, "a.exr", "a.png"}}) {
      SHOW(options[0]);
      const Outcome other = place.run(arguments + options);
      CHECK(contains(other.err, std::string(changed) + " is rendered again"));
      CHECK(!contains(other.err, std::string(kept) + " is rendered again"));
      CHECK(is_skipped(options));
      CHECK(!is_skipped({}));
    }
    // So is what is in the files.
    place.write("mesh.obj", mesh + "v 1 1 1\n");
    CHECK(!is_skipped({}));
    place.write("part.xml", part + "<!-- another -->");
    CHECK(!is_skipped({}));
    std::filesystem::rename(place.path("other.png"), place.path("t.png"));
    CHECK(!is_skipped({}));
    place.write("a.xml", s.text() + "<!-- another -->");
    CHECK(!is_skipped({}));
    CHECK(is_skipped({}));
  }

  TEST_CASE("a partial image is rendered again, whatever its name") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    const Arguments arguments{"endless.xml", "--time", "2s", "--keep-partial-name", "-v"};
    Process duet(arguments, {.directory = place.path("")});
    REQUIRE(duet.wait_for_message("built in", 300));
    duet.send(SIGUSR1);
    REQUIRE(Process::wait_until([&] { return place.has("endless.exr"); }, 300));
    duet.send(SIGKILL);
    duet.wait(300);
    const Outcome o = place.run(arguments + Arguments{"-x"});
    CAPTURE(o.err);
    CHECK(contains(o.err, "endless.exr is rendered again: its render was interrupted"));
    CHECK(contains(place.run(arguments + Arguments{"-x"}).err, "skipped"));
  }
}
