// The pages of compare, chart, stability and batch: their common style, on a phone and in the dark.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "evaluate/web/page.h"
#include "support/browser.h"
#include "support/stability_catalogue.h"

using namespace duet::test;

namespace {

using nlohmann::json;

/// A folder with a page of each command.
struct Desk : Workplace {
  Desk() {
    TinyScene lamp;
    lamp.extra = R"(<shape type="sphere"><point name="center" x="0.5" y="0.5" z="1"/>
      <float name="radius" value="0.3"/><emitter type="area"/></shape>)";
    scene("tiny.xml", lamp);
    scene("another-scene-whose-name-is-rather-long-and-has-no-space.xml", lamp);
    REQUIRE(run({"tiny.xml", "--spp", "512", "--seed", "99", "-o", "b.exr", "-q"}).code == 0);
    REQUIRE(run({"tiny.xml", "--spp", "4", "-o", "a.exr", "-q"}).code == 0);
    compare();
    chart();
    stability();
    batch();
  }
  std::string page(const std::string& name) const { return read_file(path(name)); }

 private:
  void compare() const {
    REQUIRE(run({"compare", "a.exr", "b.exr", "--html", "compare.html"}).code == 0);
  }
  void chart() const {
    REQUIRE(
        run({"chart", "tiny.xml", "another-scene-whose-name-is-rather-long-and-has-no-space.xml",
             "-i", "path,vcm:radius=0.01,alpha=0.7", "--time", "0.2s", "-o", "chart"})
            .code == 0);
  }
  /// Cells that hold, that fail as known, that do not, and that do not apply.
  void stability() const {
    std::filesystem::create_directory(path("ball"));
    write("ball/scene.xml", kBallScene);
    json row{{"name", "ball"},
             {"number", 19},
             {"title", "A ball under a sky"},
             {"about", "Its light is `grey`, see `a_name_that_is_rather_long_and_has_no_space`"},
             {"check", "energy"},
             {"scene", "ball"},
             {"define", {{"albedo", 0.5}}},
             {"spp", 8},
             {"batches", 8},
             {"most_batches", 8},
             {"reference", {{"value", 1}}},
             {"methods",
              {{"*", "holds"},
               {"bdpt", {{"fails", {-0.9, -0.1}}, {"why", "absorbs half & more"}}},
               {"ppm", {{"not applicable", "said so"}}}}}};
    json noisy = row, planned{{"name", "later"}, {"title", "Media"}, {"planned", "not yet"}};
    noisy["name"] = "noisy", noisy["methods"] = {{"*", "holds"}};
    noisy["define"] = {{"albedo", 1}};
    noisy["spp"] = 1, noisy["batches"] = 4, noisy["most_batches"] = 4;
    write("catalogue.json", json::array({row, noisy, planned}).dump());
    REQUIRE(run({"stability", "--catalogue", ".", "--html", "stability.html", "--json", "s.json"})
                .code == 1);
  }
  void batch() const {
    write("bad.xml", "<scene version='3.0.0'><shape type='spere'/></scene>");
    write("jobs.csv", "scene,output,spp\ntiny.xml,c.png,4\nbad.xml,d.png,\n");
    REQUIRE(run({"batch", "jobs.csv", "--report", "batch.html"}).code == 1);
  }
};

/// A page in a frame as wide as a phone, in the light or in the dark. What it finds: `wide`, what
/// stands out of the page; `faint`, texts whose contrast is less than 4.5 (WCAG 2.2, 1.4.3);
/// `loaded`, what comes from elsewhere; `dark`, whether the paper is.
constexpr const char* kPhone = R"(
  const frame = document.querySelector("iframe");
  const errors = [];
  // Colours as they come out, whatever they are written like.
  const brush = new OffscreenCanvas(1, 1).getContext("2d", {willReadFrequently: true});
  const rgba = (colour) => {
    brush.clearRect(0, 0, 1, 1);
    brush.fillStyle = colour;
    brush.fillRect(0, 0, 1, 1);
    return [...brush.getImageData(0, 0, 1, 1).data];
  };
  const luminance = (colour) => {
    const [r, g, b] = colour.map((v) => v / 255)
      .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const measure = () => {
    const view = frame.contentWindow, page = frame.contentDocument, root = page.documentElement;
    const behind = (e) => {
      for (; e; e = e.parentElement) {
        const colour = rgba(view.getComputedStyle(e).backgroundColor);
        if (colour[3] === 255) return colour;
      }
      return [255, 255, 255, 255];
    };
    const has_text = (e) => [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim() !== "");
    const shown = [...page.body.querySelectorAll("*")].filter((e) => e.getClientRects().length > 0);
    const faint = shown.filter((e) => has_text(e) && !e.closest("svg, script, style")).filter((e) => {
      const a = luminance(rgba(view.getComputedStyle(e).color)), b = luminance(behind(e));
      return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5;
    });
    const wide = shown.filter((e) => !e.closest(".scroll")?.contains(e.parentElement) &&
                                     e.getBoundingClientRect().right > 360.5);
    const name = (e) => e.outerHTML.slice(0, 90);
    const named = page.querySelector(".named td.name");
    finish({
      width: view.innerWidth, scrolls: root.scrollWidth, wide: wide.map(name), faint: faint.map(name),
      texts: shown.filter(has_text).length,
      loaded: view.performance.getEntriesByType("resource").map((r) => r.name),
      dark: luminance(behind(page.body)) < 0.1,
      smallest: Math.min(...shown.filter(has_text).filter((e) => !e.closest("svg"))
        .map((e) => parseFloat(view.getComputedStyle(e).fontSize))),
    });
  };
  when(() => frame.contentDocument?.readyState === "complete" &&
             frame.contentDocument.querySelector("style"), () => setTimeout(measure, 50));
)";

json on_a_phone(const std::string& program, const Desk& desk, const std::string& name, bool dark) {
  const std::string outer =
      std::string("<!doctype html><html><head><title></title></head><body style=\"color-scheme:") +
      (dark ? "dark" : "light") +
      "\"><iframe style=\"width:360px;height:720px;border:0\" srcdoc=\"" +
      duet::escape_markup(desk.page(name)) + "\"></iframe></body></html>";
  const DrivenPage page = drive_page(program, outer, kPhone, desk.path(""));
  CAPTURE(page.console);
  return json::parse(page.result);
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the pages of compare, chart, stability and batch on a phone and in the dark") {
    const std::string program = browser();
    if (program.empty()) {
      MESSAGE("skipped: DUET_BROWSER is none");
      return;
    }
    const Desk desk;
    for (const std::string name : {"compare.html", "chart/tiny/index.html", "chart/index.html",
                                   "stability.html", "batch.html"})
      for (const bool dark : {false, true}) {
        CAPTURE(name);
        CAPTURE(dark);
        const json seen = on_a_phone(program, desk, name, dark);
        CAPTURE(seen.dump());
        CHECK(seen["width"] == 360);
        CHECK(seen["scrolls"] <= 360);
        CHECK(seen["wide"] == json::array());
        CHECK(seen["faint"] == json::array());
        CHECK(seen["loaded"] == json::array());
        CHECK(seen["texts"] > 20);
        CHECK(seen["smallest"] >= 10);
        CHECK(seen["dark"] == dark);
      }
  }
}
