// What the program takes from its environment, and what shells and man get of its command line.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "app/workplace.h"
#include "base/system/run_program.h"
#include "support/files.h"

using namespace duet::test;

namespace {

/// Names of commands and options, as --help has them at the beginning of lines: "-t,--threads".
std::set<std::string> names_in_help(const std::string& help, const std::string& expression) {
  std::set<std::string> names;
  const std::regex line("(?:^|\n)  (" + expression + ")"), name("[^,]+");
  for (std::sregex_iterator l(help.begin(), help.end(), line), end; l != end; ++l) {
    const std::string all = (*l)[1];
    for (std::sregex_iterator n(all.begin(), all.end(), name); n != end; ++n)
      if (n->str() != "-h" && n->str() != "--help") names.insert(n->str());
  }
  return names;
}

/// What bash offers for the last of the words.
std::string offered(const Workplace& place, const std::string& words, int count) {
  const duet::ProgramEnd end = duet::run_program(
      {duet::find_program("bash"), "-c",
       "source " + place.path("bash") + "; COMP_WORDS=(" + words +
           "); COMP_CWORD=" + std::to_string(count - 1) + "; _duet; echo \"${COMPREPLY[*]}\""});
  CHECK(end.err.empty());
  return end.out;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("completions and the manual page have every command and every option") {
    const Workplace place;
    const std::string help = place.run({"--help"}).out;
    const std::set<std::string> commands =
        names_in_help(help.substr(help.find("Subcommands:")), "[a-z]+");
    REQUIRE(commands.contains("render"));
    REQUIRE(commands.size() == 12);
    int options = 0;
    for (const std::string shell : {"bash", "zsh", "fish", "man"}) {
      CAPTURE(shell);
      const Outcome o = place.run({"completion", shell});
      REQUIRE(o.code == 0);
      for (const std::string& command : commands) {
        CAPTURE(command);
        CHECK(contains(o.out, command));
        const std::string of_command = place.run({command, "--help"}).out;
        for (std::string name : names_in_help(of_command, "-[-a-zA-Z,]+")) {
          CAPTURE(name);
          if (shell == "fish")
            name = name.starts_with("--") ? "-l " + name.substr(2) : "-s " + name.substr(1);
          if (shell == "man") name = std::regex_replace(name, std::regex("-"), "\\-");
          CHECK(contains(o.out, name));
          ++options;
        }
      }
    }
    CHECK(options > 4 * 80);
    CHECK(place.run({"completion", "csh"}).code == 2);
  }

  TEST_CASE("bash completes commands, options and their values") {
    const Workplace place;
    place.write("bash", place.run({"completion", "bash"}).out);
    CHECK(offered(place, "duet mer", 2) == "merge\n");
    CHECK(offered(place, "duet render a.xml --prog", 4) == "--progress\n");
    CHECK(offered(place, "duet a.xml --light-selection b", 4) == "bvh\n");
    CHECK(offered(place, "duet a.xml -i bd", 4) == "bdpt\n");
    CHECK(offered(place, "duet help ch", 3) == "chart\n");
    CHECK(offered(place, "duet completion f", 3) == "fish\n");
    CHECK(offered(place, "duet plugins rf", 3) == "rfilter\n");
    CHECK(offered(place, "duet a.xml --aov dep", 4) == "depth\n");
    CHECK(offered(place, "duet a.xml --aov albedo,dep", 4) == "albedo,depth\n");
    CHECK(offered(place, "duet a.xml --cryptomatte object,m", 4) == "object,material\n");
    CHECK(offered(place, "duet a.xml --tonemap srgb,a", 4) == "\n");
    // Files, by bash itself.
    CHECK(offered(place, "duet render -o a", 4) == "\n");
  }

  TEST_CASE("help and the manual page have the exit codes and the environment") {
    const Workplace place;
    const std::string help = place.run({"--help"}).out;
    const std::string page = place.run({"completion", "man"}).out;
    CHECK(contains(help, "Exit codes:\n  0   "));
    CHECK(contains(page, ".SH EXIT STATUS\n.TP\n\\fB0\\fR\n"));
    for (const char* name : {"DUET_THREADS", "DUET_PATH", "DUET_MEMORY_LIMIT", "DUET_IMAGE_MODULE",
                             "DUET_OIDN_LIBRARY", "129, 130, 143"}) {
      CAPTURE(name);
      CHECK(contains(help, std::string("\n  ") + name + " "));
      CHECK(contains(page, std::string(".TP\n\\fB") + name + "\\fR\n"));
    }
  }

  TEST_CASE("every line of the manual page is text or a macro that man knows") {
    const std::string page = Workplace().run({"completion", "man"}).out;
    const std::set<std::string> macros{"TH", "SH", "SS", "TP", "PP", "B", "br", "nf", "fi"};
    std::istringstream lines(page);
    int found = 0;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with('.') && !line.starts_with('\'')) continue;
      CAPTURE(line);
      CHECK(macros.contains(line.substr(1, line.find(' ') - 1)));
      ++found;
    }
    CHECK(found > 200);
  }

  TEST_CASE("the version with all that goes into it") {
    const Workplace place;
    CHECK(place.run({"--version"}).out == "duet " DUET_VERSION "\n");
    const std::string all = place.run({"--version", "--verbose"}).out;
    for (const char* name :
         {"compiler", "processor", "Embree", "oneTBB", "OpenEXR", "OpenImageIO", "pugixml"})
      CHECK(std::regex_search(all, std::regex(std::string("\n") + name + " +\\S+")));
  }

  TEST_CASE("threads and folders by the environment") {
    const Workplace place;
    TinyScene part;
    part.extra = R"(<include filename="part.xml"/>)";
    place.scene("tiny.xml", part);
    std::filesystem::create_directory(place.path("parts"));
    place.write("parts/part.xml", R"(<scene version="3.0.0"><shape type="sphere"/></scene>)");
    const auto run = [&](const std::string& threads, const std::string& path) {
      return run_duet({"tiny.xml", "-o", "a.exr", "--stats", "s.json"},
                      {.directory = place.path(""),
                       .environment = {{"DUET_THREADS", threads}, {"DUET_PATH", path}}});
    };
    CHECK(contains(run("1", "").err, "part.xml"));
    for (const char* threads : {"1", "2"}) {
      CHECK(run(threads, "/does/not/exist::" + place.path("parts")).code == 0);
      const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
      CHECK(stats["threads"] == std::stoi(threads));
    }
    for (const char* threads : {"0", "two", "1025", "3x"}) {
      const Outcome o = run(threads, place.path("parts"));
      CHECK(o.code == 2);
      CHECK(
          contains(o.err, "DUET_THREADS: \"" + std::string(threads) + "\" is not a whole number"));
    }
  }
}
