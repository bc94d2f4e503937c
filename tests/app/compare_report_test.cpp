// duet compare: the reports of two directories.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "image/image_io.h"
#include "support/browser.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Two directories, and images to put there.
struct Folders : Workplace {
  Folders() {
    for (const char* d : {"a", "b"}) std::filesystem::create_directory(path(d));
    write_image("reference.exr", 0);
    write_image("good.exr", 0.2f);
    write_image("shifted.exr", 0.3f);
    write_image("nan.exr", 0.2f, NAN);
  }
  /// Values by turns above and below 1; the first one times `first`.
  void write_image(const std::string& name, float rmse, float first = 1) const {
    Image image(16, 16, {"R", "G", "B"});
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = 1 + (i % 2 == 0 ? rmse : -rmse);
    image.data[0] *= first;
    ExrOptions options;
    options.half = false;
    write_exr(path(name), image, options);
  }
  Outcome compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run(arguments);
  }
};

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("what only one of two directories has") {
    const Folders g;
    for (const char* d : {"c", "empty"}) std::filesystem::create_directory(g.path(d));
    const auto copy = [&](const char* from, const char* to) {
      std::filesystem::copy(g.path(from), g.path(to));
    };
    copy("good.exr", "a/one.exr");
    copy("reference.exr", "b/one.exr");
    copy("good.exr", "a/extra.exr");
    copy("reference.exr", "b/lost.exr");
    const std::vector<std::string> reports{"a", "b", "--junit", "j.xml", "--html", "r.html"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), reports.begin(), reports.end());
      return g.compare(more);
    };
    const Outcome plain = with({});
    CHECK(plain.code == 0);
    CHECK(contains(plain.err, "extra.exr: no reference in b"));
    CHECK(contains(plain.err, "lost.exr: no image in a"));
    CHECK(contains(plain.out, "extra.exr  MISSING             no reference in b"));
    CHECK(contains(plain.out, "lost.exr   MISSING             no image in a"));
    CHECK(contains(plain.out, "1 compared: 1 "));
    CHECK(contains(plain.out, "1 MISSING in b; 1 MISSING in a"));
    std::string junit = read_file(g.path("j.xml"));
    CHECK(contains(junit, "tests=\"3\" failures=\"0\" errors=\"0\" skipped=\"2\""));
    CHECK(contains(junit, "<skipped message=\"no reference in b\"/>"));
    const std::string page = read_file(g.path("r.html"));
    CHECK(contains(page, "<tr data-verdict=\"MISSING\"><td class=\"name\">extra.exr</td>"));
    CHECK(contains(page, "badge missing"));
    CHECK(contains(page, "1 MISSING in b; 1 MISSING in a"));

    const Outcome complete = with({"--require-complete"});
    CHECK(complete.code == 3);
    junit = read_file(g.path("j.xml"));
    CHECK(contains(junit, "tests=\"3\" failures=\"2\" errors=\"0\" skipped=\"0\""));
    CHECK(contains(junit, "<failure type=\"MISSING\" message=\"no image in a\"/>"));
    // What was not rendered meets no limit; what has no reference has none.
    CHECK(with({"--require", "relrmse<0.25"}).code == 3);
    junit = read_file(g.path("j.xml"));
    CHECK(contains(junit, "failures=\"1\" errors=\"0\" skipped=\"1\""));
    std::filesystem::remove(g.path("b/lost.exr"));
    CHECK(with({"--require", "relrmse<0.25"}).code == 0);
    CHECK(with({"--require-complete"}).code == 3);
    std::filesystem::remove(g.path("a/extra.exr"));
    CHECK(with({"--require-complete", "--require", "relrmse<0.25"}).code == 0);

    copy("good.exr", "a/extra.exr");
    const auto j = nlohmann::json::parse(with({"--json"}).out);
    REQUIRE(j.size() == 2);
    CHECK(j[0]["name"] == "extra.exr");
    CHECK(j[0]["verdict"] == "MISSING");
    CHECK(j[0]["only_in"] == "image");
    CHECK_FALSE(j[0].contains("rmse"));
    // An image that cannot be read is an error whatever else there is.
    g.write("a/one.exr", "nothing");
    CHECK(with({"--require-complete"}).code == 1);
    CHECK(contains(read_file(g.path("j.xml")), "errors=\"1\""));
    CHECK(contains(read_file(g.path("r.html")), "badge error"));
    // Nothing in common is most likely a mistake.
    copy("good.exr", "c/other.exr");
    const Outcome nothing = g.compare({"c", "b"});
    CHECK(nothing.code == 1);
    CHECK(contains(nothing.err, "no image of the same name"));
    CHECK(g.compare({"empty", "b", "--require-complete"}).code == 3);
    CHECK(g.compare({"good.exr", "reference.exr", "--require-complete"}).code == 2);
  }

  TEST_CASE("the report is sorted and filtered in a browser") {
    const std::string program = browser();
    if (program.empty()) {
      MESSAGE("skipped: DUET_BROWSER is none");
      return;
    }
    const Folders g;
    for (const auto& [from, name] : {std::pair("good.exr", "2.exr"),
                                     {"shifted.exr", "10.exr"},
                                     {"reference.exr", "1.exr"},
                                     {"nan.exr", "3.exr"}}) {
      std::filesystem::copy(g.path(from), g.path(std::string("a/") + name));
      std::filesystem::copy(g.path("reference.exr"), g.path(std::string("b/") + name));
    }
    std::filesystem::copy(g.path("good.exr"), g.path("b/lost.exr"));
    REQUIRE(g.compare({"a", "b", "--html", "r.html", "--require", "rmse<0.25"}).code == 3);
    const DrivenPage page = drive_page(program, read_file(g.path("r.html")), R"(
      const errors = [];
      addEventListener("error", (e) => errors.push(e.message));
      const table = document.getElementById("outcomes"), heads = [...table.tHead.rows[0].cells];
      const names = () => [...table.tBodies[0].rows].filter((r) => r.offsetHeight > 0)
        .map((r) => r.cells[0].textContent);
      const column = (name) => heads.find((h) => h.textContent === name);
      const sort = (name) => { column(name).querySelector("button").click(); return names(); };
      // What can be reached with the keyboard is a button.
      const reachable = heads.every((h) => h.querySelector("button").tabIndex === 0);
      const by_error = sort("relrmse"), order = column("relrmse").getAttribute("aria-sort");
      const from_largest = sort("relrmse"), other_order = column("relrmse").getAttribute("aria-sort");
      const by_name = sort("image"), only_one = document.querySelectorAll("[aria-sort]").length;
      const bar = document.querySelector(".filter");
      const toggle = (verdict) => [...bar.querySelectorAll("button")]
        .find((b) => b.textContent.startsWith(verdict + " ")).click();
      toggle("MISSING");
      const without_missing = names(), status = bar.querySelector("[role=status]").textContent;
      toggle("PASS"); toggle("FAIL");
      const rest = names();
      const sections = [...document.querySelectorAll("section")].filter((e) => e.offsetHeight > 0)
        .map((e) => e.dataset.verdict);
      toggle("PASS");
      document.documentElement.style.width = "1100px";
      const fits = [...document.querySelectorAll(".scroll")].filter((e) => e.offsetHeight > 0)
        .every((e) => e.scrollWidth <= e.clientWidth);
      finish({fits, reachable, by_error, order, from_largest, other_order, by_name, only_one,
              without_missing, status, rest, sections, again: names().length, errors});
    )",
                                       g.path(""));
    CAPTURE(page.console);
    const auto r = nlohmann::json::parse(page.result);
    using List = nlohmann::json;
    CHECK(r["reachable"] == true);
    CHECK(r["fits"] == true);
    // The image with holes has the error of the rest of its pixels; what was not compared is last.
    CHECK(r["by_error"][0] == "1.exr");
    CHECK(r["by_error"][3] == "10.exr");
    CHECK(r["by_error"][4] == "lost.exr");
    CHECK(r["order"] == "ascending");
    CHECK(r["from_largest"][0] == "10.exr");
    CHECK(r["from_largest"][4] == "lost.exr");
    CHECK(r["other_order"] == "descending");
    CHECK(r["by_name"] == List{"1.exr", "2.exr", "3.exr", "10.exr", "lost.exr"});
    CHECK(r["only_one"] == 1);
    CHECK(r["without_missing"] == List{"1.exr", "2.exr", "3.exr", "10.exr"});
    CHECK(r["status"] == "4 of 5 shown");
    CHECK(r["rest"] == List{"10.exr"});
    CHECK(r["sections"] == List{"NOISY"});
    CHECK(r["again"] == 3);
    CHECK(r["errors"].empty());
    CHECK(page.console.empty());
  }
}
