// duet stability: catalogues, verdicts and exit codes. The catalogue itself is run by the test
// stability_fast, and wholly by the slow one.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/workplace.h"
#include "support/source_path.h"
#include "support/stability_catalogue.h"

using namespace duet::test;

namespace {

using nlohmann::json;

/// A folder with a catalogue of one row: a grey ball under a white sky, whose mean is not 1.
struct Cabinet : Workplace {
  Cabinet() {
    std::filesystem::create_directory(path("ball"));
    write("ball/scene.xml", kBallScene);
  }
  static json row() {
    json row = ball_row();
    row["fast"] = true;
    return row;
  }
  void catalogue(const json& rows) const { write("catalogue.json", rows.dump()); }
  Outcome stability(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"stability", "--catalogue", "."});
    return run(arguments);
  }
  /// The outcome for a catalogue of this one row.
  Outcome judge(const json& r) const {
    catalogue(json::array({r}));
    return stability({"--methods", "path,bdpt"});
  }
};

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("stability: what is as expected, and what is not") {
    const Cabinet c;
    json row = Cabinet::row();
    const Outcome holds = c.judge(row);
    CHECK(holds.code == 0);
    CHECK(contains(holds.out, "2 of 2 cells as expected"));
    CHECK(contains(holds.err, "[1/1] ball"));

    // A failure that is not expected.
    row["define"] = {{"albedo", 0.5}};
    const Outcome fails = c.judge(row);
    CHECK(fails.code == 1);
    CHECK(contains(fails.out, "NOT AS EXPECTED: fails, but is expected to hold"));
    CHECK(contains(fails.out, "0 of 2 cells as expected"));

    // A known one, of its known size and of another; and one that has gone.
    const auto known = [](double least, double most) {
      return json{{"fails", {least, most}}, {"why", "absorbs half"}};
    };
    row["methods"] = {{"*", known(-0.4, -0.1)}};
    const Outcome as_known = c.judge(row);
    CHECK(as_known.code == 0);
    CHECK(contains(as_known.out, "fails as known (-40.0 % to -10.0 %)"));
    row["methods"] = {{"*", known(-0.02, 0)}};
    const Outcome worse = c.judge(row);
    CHECK(worse.code == 1);
    CHECK(contains(worse.out, "fails, but not by -2.00 % to 0.00 %"));
    row["define"] = json::object();
    row["methods"] = {{"*", known(-0.4, 0.1)}};
    const Outcome gone = c.judge(row);
    CHECK(gone.code == 1);
    CHECK(contains(gone.out, "holds, but is known to fail"));

    // One method alone decides, and what does not apply does not count.
    row["methods"] = {{"*", "holds"}, {"bdpt", {{"not applicable", "said so"}}}};
    const Outcome partly = c.judge(row);
    CHECK(partly.code == 0);
    CHECK(contains(partly.out, "1 of 1 cells as expected"));
  }

  TEST_CASE("stability: files, the same for any number of threads") {
    const Cabinet c;
    json planned{{"name", "later"}, {"number", 41}, {"title", "Media"}, {"planned", "not yet"}};
    json known = Cabinet::row();
    known["name"] = "grey", known["define"] = {{"albedo", 0.5}};
    known["methods"] = {{"*", {{"fails", {-0.4, -0.1}}, {"why", "absorbs half"}}}};
    c.catalogue(json::array({Cabinet::row(), known, planned}));
    const Outcome one = c.stability(
        {"-q", "-t", "1", "--json", "a.json", "--markdown", "a.md", "--html", "a.html"});
    CHECK(one.code == 0);
    CHECK(one.err.empty());
    CHECK(c.stability({"-q", "-t", "3", "--json", "b.json"}).out == one.out);
    const json a = json::parse(read_file(c.path("a.json")));
    REQUIRE(a.size() == 3);
    CHECK(a[0]["cells"].size() == 8);
    CHECK(a[1]["cells"][0]["holds"] == false);
    CHECK(a[1]["cells"][0]["as_expected"] == true);
    CHECK(a[2]["planned"] == "not yet");
    const std::string page = read_file(c.path("a.md"));
    CHECK(contains(page, "| 19 | [ball](#ball) | A white ball is seen | ✓"));
    CHECK(contains(page, "**✗ -"));
    CHECK(contains(page, "| 41 | [later](#later) | Media | planned |"));
    CHECK(contains(page, "absorbs half"));
    const std::string html = read_file(c.path("a.html"));
    CHECK(contains(html, "<p class=\"soft\">14 of 14 cells as expected.</p>"));
    CHECK(contains(html, "<span class=\"badge pass\">✓ "));
    CHECK(contains(html, "<span class=\"badge noisy\">✗ -"));
    CHECK(contains(html, "<br><span class=\"interval\">notices "));
    CHECK(contains(html, "(bound 1.00 %)"));
    CHECK(contains(html, "<tr data-verdict=\"planned\">"));
    CHECK(contains(html, "absorbs half"));
    CHECK(contains(html, "--html a.html</pre>"));
    // Named by number, and the short run.
    CHECK(contains(c.stability({"41"}).out, "planned: not yet"));
    CHECK(contains(c.stability({"--fast", "--list"}).out, "19 ball"));
    CHECK(!contains(c.stability({"--fast", "--list"}).out, "later"));
  }

  TEST_CASE("stability: what a measurement is too noisy to see does not hold") {
    const Cabinet c;
    json row = Cabinet::row();
    row["spp"] = 1, row["batches"] = 4, row["most_batches"] = 4;
    const Outcome noisy = c.judge(row);
    CHECK(noisy.code == 1);
    CHECK(contains(noisy.out, "NOT RESOLVED"));
    CHECK(contains(noisy.out, "0 of 2 cells as expected, 2 not resolved"));
    CHECK(contains(noisy.out, "(bound 1.00 %)"));
    CHECK(contains(noisy.out, "4 images"));

    // More images, until it is seen; then as many as that takes, and no more.
    row["most_batches"] = 4096;
    c.catalogue(json::array({row}));
    const Outcome enough = c.stability({"--methods", "path,bdpt", "--json", "a.json"});
    CHECK(enough.code == 0);
    const json rows = json::parse(read_file(c.path("a.json")));
    for (const json& cell : rows[0]["cells"]) {
      CHECK(cell["resolved"] == true);
      CHECK(cell["notices"].get<double>() > 0.003);
      CHECK(cell["notices"].get<double>() <= 0.01);
      CHECK(cell["has_to_notice"] == doctest::Approx(0.01));
    }

    // The short run has coarser bounds, and says so.
    row["most_batches"] = 64;
    c.catalogue(json::array({row}));
    const Outcome fast = c.stability({"--methods", "path,bdpt", "--fast"});
    CHECK(fast.code == 0);
    CHECK(contains(fast.out, "(bound 5.00 %)"));
    CHECK(contains(fast.out, "5 times as coarse"));

    // A failure that is seen needs no power.
    row["define"] = {{"albedo", 0.2}}, row["most_batches"] = 4;
    row["methods"] = {{"*", {{"fails", {-0.9, -0.01}}, {"why", "absorbs most"}}}};
    CHECK(c.judge(row).code == 0);
  }

  TEST_CASE("stability: only what merges may be off by the margin") {
    const Cabinet c;
    for (const char* folder : {"room", "parts"})
      std::filesystem::create_directory_symlink(source_path("scenes/stability/") + folder,
                                                c.path(folder));
    // Against the same images of a light that is stronger by 3 %: without noise.
    json row = Cabinet::row();
    row["scene"] = "room/point.xml", row["define"] = {{"intensity", 1}};
    row["parameters"] = {{"*", {{"max_depth", 4}}}};
    row["spp"] = 4, row["margin"] = 0.05;
    row["reference"] = {{"method", "self"}, {"define", {{"intensity", 1.03}}}};
    const auto run = [&](const char* method) {
      c.catalogue(json::array({row}));
      return c.stability({"--methods", method});
    };
    row["methods"] = {{"*", "holds"}, {"auto", "holds"}};
    CHECK(run("vcm").code == 0);
    CHECK(run("bdpt").code == 1);
    const Outcome unbiased = run("auto");
    CHECK(unbiased.code == 1);
    CHECK(!contains(unbiased.out, "takes vcm"));
    // Light of a point in a mirror's reflection is found by merging alone.
    row["define"] = {{"intensity", 1}, {"right", "mirror"}, {"ball", "mirror"}, {"ball2", "glass"}};
    const Outcome merged = run("auto");
    CHECK(merged.code == 0);
    CHECK(contains(merged.out, "takes vcm"));
    // Twice the margin is too much for all.
    row["reference"]["define"]["intensity"] = 1.12;
    CHECK(run("auto").code == 1);
  }

  TEST_CASE("stability: images that stop adaptively") {
    const Cabinet c;
    json row = Cabinet::row();
    row["check"] = "noise", row["limit"] = 0.25, row["define"] = {{"albedo", 0.5}};
    row.erase("reference"), row.erase("margin");
    row["spp"] = 1, row["batches"] = 32;
    CHECK(c.judge(row).code == 1);
    // --target-error counts samples by the error, not by `spp`.
    row["target_error"] = 0.02;
    const Outcome stopped = c.judge(row);
    CHECK(stopped.code == 0);
    CHECK(contains(stopped.out, "2 of 2 cells as expected"));
  }

  TEST_CASE("stability: limits and what is noticed are printed in their own units") {
    const Cabinet c;
    json tiles = Cabinet::row(), bits = Cabinet::row(), noise = Cabinet::row();
    tiles["check"] = "tiles", tiles["tiles"] = 2;
    bits["name"] = "bits", bits["check"] = "bits", bits["batches"] = 1;
    noise["name"] = "noise", noise["check"] = "noise", noise["limit"] = 0.5;
    bits.erase("margin"), noise.erase("margin");
    c.catalogue(json::array({tiles, bits, noise}));
    CHECK(c.stability({"-q", "--markdown", "a.md"}).code == 0);
    const std::string page = read_file(c.path("a.md"));
    CHECK(contains(
        page, "Check `tiles`; limit: a mean z² of 3.4; methods that merge may be off by 2.00 %."));
    CHECK(contains(page, "Check `bits`; limit: below 1."));
    CHECK(contains(page, "Check `noise`; limit: below 50.0 %."));
    CHECK(contains(page, "| exact | holds |"));
    CHECK(contains(page, "(bound 5.00 %) | holds |"));
    CHECK(contains(page, "(bound 100.0 %) | holds |"));
  }

  TEST_CASE("stability: a part of the page is brought up to date") {
    const Cabinet c;
    json second = Cabinet::row();
    second["name"] = "second", second["title"] = "Another ball";
    c.catalogue(json::array({Cabinet::row(), second}));
    CHECK(c.stability({"-q", "--markdown", "a.md"}).code == 0);
    const std::string whole = read_file(c.path("a.md"));
    // The same again is the same page.
    CHECK(c.stability({"-q", "second", "--methods", "vcm,auto", "--markdown", "a.md"}).code == 0);
    CHECK(read_file(c.path("a.md")) == whole);
    // A cell that has changed, and everything else as it was.
    second["methods"] = {{"*", "holds"}, {"bdpt", {{"not applicable", "said so"}}}};
    second["title"] = "A ball of another title";
    c.catalogue(json::array({Cabinet::row(), second}));
    CHECK(c.stability({"-q", "second", "--methods", "bdpt", "--markdown", "a.md"}).code == 0);
    const std::string page = read_file(c.path("a.md"));
    CHECK(contains(page, "| bdpt | – | – | not applicable | said so |"));
    CHECK(contains(page, "A ball of another title"));
    const auto section = [](const std::string& text, const std::string& from) {
      return text.substr(text.find(from), text.find("### second") - text.find(from));
    };
    CHECK(section(page, "### ball") == section(whole, "### ball"));
    CHECK(page.find("| path |", page.find("### second")) != std::string::npos);
  }

  TEST_CASE("stability: what there is not") {
    const Cabinet c;
    c.catalogue(json::array({Cabinet::row()}));
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {{"bal"}, "did you mean \"ball\"?"},
        {{"7"}, "--list"},
        {{"--methods", "path,bdtp"}, "did you mean \"bdpt\"?"},
        {{"--methods", "path", "--markdown", "a.md"}, "a.md is not there"},
        {{"--json", "/dev/null/a.json"}, "/dev/null"},
        {{"--html", "/dev/null/a.html"}, "/dev/null"},
        {{"-t", "0"}, "--threads"},
    };
    for (const auto& [arguments, named] : cases) {
      const Outcome o = c.stability(arguments);
      CAPTURE(o.err);
      CHECK(o.code == 2);
      CHECK(contains(o.err, named));
    }
    const Outcome o = c.run({"stability", "--catalogue", "nowhere"});
    CHECK(o.code == 2);
    CHECK(contains(o.err, "nowhere"));
  }

  TEST_CASE("stability: the catalogue has all 42 failures and can be read") {
    const Workplace place;
    CHECK(place.run({"stability", "--list"}).code == 0);
    const json rows = json::parse(read_file(source_path("scenes/stability/catalogue.json")));
    std::set<int> numbers;
    for (const json& row : rows) numbers.insert(row.value("number", 0));
    for (int n = 1; n <= 42; ++n) {
      CAPTURE(n);
      CHECK(numbers.contains(n));
    }
  }

  TEST_CASE("stability: mistakes in a catalogue are named") {
    const Cabinet c;
    const auto refused = [&](const char* key, const json& value, const char* named) {
      json row = Cabinet::row();
      row[key] = value;
      c.catalogue(json::array({row}));
      const Outcome o = c.stability({});
      CAPTURE(o.err);
      CHECK(o.code == 1);
      CHECK(contains(o.err, named));
    };
    refused("limmit", 1, "unknown key \"limmit\" (did you mean \"limit\"?)");
    refused("define", json{{"albdo", 1}}, "has no parameter $albdo");
    refused("parameters", json{{"*", {{"depth", 1}}}}, "no parameter \"depth\"");
  }
}
