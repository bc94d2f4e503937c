// duet chart: its files, its page in a browser, external renderers and bad input.
#include <doctest/doctest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "app/workplace.h"
#include "image/image_io.h"
#include "support/browser.h"

using namespace duet;
using namespace duet::test;

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// The lines of a CSV file without quotes.
Rows csv(const std::string& text) {
  Rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    for (size_t from = 0; from <= line.size();) {
      const size_t to = std::min(line.find(',', from), line.size());
      rows.back().push_back(line.substr(from, to - from));
      from = to + 1;
    }
  }
  return rows;
}

/// A scene with noise: a lamp with area.
TinyScene lamp_scene() {
  TinyScene s;
  s.extra = R"(<shape type="sphere"><point name="center" x="0.5" y="0.5" z="1"/>
    <float name="radius" value="0.3"/><emitter type="area"><rgb name="radiance" value="3"/></emitter>
    </shape>)";
  return s;
}

struct Studio : Workplace {
  Studio() {
    scene("tiny.xml", lamp_scene());
    // With a seed of its own: else a chart would compare samples with themselves.
    REQUIRE(run({"tiny.xml", "--spp", "512", "--seed", "99", "-o", "reference.exr", "-q"}).code ==
            0);
  }
  Outcome chart(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "chart");
    return run(arguments);
  }
  std::string file(const std::string& name) const { return read_file(path(name)); }
};

/// The numbers in a polyline's points.
std::vector<std::pair<double, double>> polyline(const std::string& svg, const std::string& line) {
  const size_t group = svg.find("data-name=\"" + line + "\"");
  REQUIRE(group != std::string::npos);
  const size_t from = svg.find("<polyline points=\"", group) + 18;
  std::istringstream in(svg.substr(from, svg.find('"', from) - from));
  std::vector<std::pair<double, double>> points;
  char comma = 0;
  for (double x = 0, y = 0; in >> x >> comma >> y;) points.emplace_back(x, y);
  return points;
}

/// How many labels of ticks have this attribute.
size_t labels(const std::string& svg, const std::string& attribute) {
  const size_t from = svg.find("<g class=\"ticks\">");
  return occurrences(svg.substr(from, svg.find("</g>", from) - from), attribute);
}

/// No colour of a chart is fixed where a dark page needs another one.
void check_dark_mode(const std::string& text) {
  const size_t from = text.find("<svg"), style = text.find("<style>", from);
  const size_t end = text.find("</svg>", from);
  REQUIRE(style < end);
  const size_t dark = text.find("@media (prefers-color-scheme: dark)", style);
  REQUIRE(dark < end);
  for (const char* part : {"svg.chart", ".paper", ".soft", ".grid", ".frame", ".guides", ".noise",
                           ".series-0", ".series-7"})
    CHECK(text.find(part, dark) < text.find("</style>", dark));
  // Lines, bands and markers take the colour of their group.
  const size_t line = text.find("<g class=\"line series-", from);
  const std::string group = text.substr(line, text.find("</g>", line) - line);
  CHECK(occurrences(group, "=\"#") == 0);
  CHECK(occurrences(group, "currentColor") >= 4);
}

struct Efficiency {
  double value, low, high;
  std::string mark;
};

/// The cells of a page's column of efficiencies.
std::vector<Efficiency> efficiencies(const std::string& page) {
  static const std::regex cell(
      "<td( class=\"(best|tied)\")? data-value=\"([^\"]+)\">[^<]*<br><span class=\"interval\">"
      "\\[([0-9.e+]+), ([0-9.e+]+|∞)\\]</span></td>");
  std::vector<Efficiency> list;
  for (std::sregex_iterator i(page.begin(), page.end(), cell), end; i != end; ++i)
    list.push_back({std::stod((*i)[3]), std::stod((*i)[4]),
                    (*i)[5] == "∞" ? INFINITY : std::stod((*i)[5]), (*i)[2]});
  return list;
}

/// "best" only where the interval overlaps none of the others.
void check_marks(const std::string& page) {
  const std::vector<Efficiency> all = efficiencies(page);
  REQUIRE(all.size() == 2);
  const Efficiency& best = all[0].value > all[1].value ? all[0] : all[1];
  const Efficiency& other = all[0].value > all[1].value ? all[1] : all[0];
  // The page shows three digits of them.
  if (std::abs(other.high / best.low - 1) < 0.01) return;
  const bool apart = other.high < best.low;
  CAPTURE(best.low);
  CAPTURE(other.high);
  CHECK(best.mark == (apart ? "best" : "tied"));
  CHECK(other.mark == (apart ? "" : "tied"));
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("a chart has its files, and they agree") {
    const Studio s;
    const Outcome o = s.chart({"tiny.xml", "-i", "path,bdpt:rr_depth=9,max_depth=3", "--time",
                               "1.2s", "--reference", "reference.exr", "-o", "out", "-t", "1"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "of the best efficiency"));
    const Rows rows = csv(s.file("out/chart.csv"));
    REQUIRE(rows.size() > 6);
    CHECK(rows[0] == std::vector<std::string>{"integrator", "seconds", "cpu_seconds", "spp", "rmse",
                                              "relmse", "trimmed", "firefly"});
    // The name with a comma is in quotes and so falls apart here.
    size_t of_path = 0;
    double seconds = 0, spp = 0;
    for (const auto& row : rows) {
      if (row[0] != "path") continue;
      ++of_path;
      CHECK(std::stod(row[1]) > seconds);
      CHECK(std::stod(row[3]) > spp);
      seconds = std::stod(row[1]), spp = std::stod(row[3]);
      CHECK(std::stod(row[4]) > 0);
    }
    CHECK(of_path >= 3);
    CHECK(seconds < 1.2);
    CHECK(seconds > 0.3);
    CHECK(contains(s.file("out/chart.csv"), "\"bdpt:rr_depth=9,max_depth=3\","));

    for (const char* name : {"out/chart.svg", "out/chart-spp.svg"}) {
      CAPTURE(name);
      const std::string svg = s.file(name);
      CHECK(svg.starts_with("<svg xmlns="));
      CHECK(occurrences(svg, "<g class=\"line series-") == 2);
      CHECK(occurrences(svg, "<polyline") == 2);
      CHECK(occurrences(svg, "class=\"band\"") == 2);
      CHECK(occurrences(svg, "class=\"guide\"") == 2);
      CHECK(occurrences(svg, "class=\"entry\"") == 2);
      CHECK(contains(svg, "data-slope=\"-0.5000\""));
      CHECK(contains(svg, "data-slope=\"-0.3333\""));
      CHECK(contains(svg, "slope −0."));
      CHECK(occurrences(svg, "<g") == occurrences(svg, "</g>"));
      CHECK_FALSE(contains(svg, "nan"));
      CHECK_FALSE(contains(svg, "inf"));
      CHECK(contains(svg, "√trimmed (root of the trimmed relMSE)"));
      CHECK(labels(svg, "text-anchor=\"middle\"") >= 3);
      CHECK(labels(svg, "text-anchor=\"end\"") >= 3);
      check_dark_mode(svg);
      const auto line = polyline(svg, "path");
      CHECK(line.size() == of_path);
      CHECK(std::is_sorted(line.begin(), line.end()));
      // The error falls: downwards is up in y.
      CHECK(line.back().second > line.front().second + 20);
      for (const auto& [x, y] : line) {
        CHECK((x >= 70 && x <= 510));
        CHECK((y >= 58 && y <= 388));
      }
    }

    const std::string page = s.file("out/index.html");
    CHECK(page.starts_with("<!doctype html>"));
    // Nothing is fetched: the only addresses are the names of SVG.
    CHECK(occurrences(page, "http") == occurrences(page, "http://www.w3.org/2000/svg"));
    CHECK_FALSE(contains(page, " src="));
    CHECK_FALSE(contains(page, "@import"));
    CHECK(occurrences(page, "<svg") == 2);
    CHECK(contains(page, "duet chart tiny.xml -i path,bdpt:rr_depth=9,max_depth=3"));
    check_marks(page);
    check_dark_mode(page);
    const size_t from = page.find("<script type=\"application/json\">") + 32;
    const auto data = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    CHECK(data["images"].size() == 3);
    CHECK(data["reference"] == 2);
    CHECK(data["images"][1]["name"] == "bdpt:rr_depth=9,max_depth=3");
    // 16 × 12 pixels of three numbers of two bytes, in base64; and one byte of FLIP.
    for (const auto& i : data["images"]) {
      CHECK(std::string(i["half"]).size() == 16 * 12 * 6 / 3 * 4);
      if (i["name"] == "reference") {
        CHECK_FALSE(i.contains("flip"));
        continue;
      }
      CHECK(std::string(i["flip"]).size() == 16 * 12 / 3 * 4);
      CHECK(double(i["mean_flip"]) > 0);
    }
  }

  TEST_CASE("the last image of a chart is that of a plain render") {
    const Studio s;
    REQUIRE(s.chart({"tiny.xml", "-i", "path", "--time", "0.3s", "--reference", "reference.exr",
                     "-t", "1", "-o", "out", "--seed", "5"})
                .code == 0);
    const Rows rows = csv(s.file("out/chart.csv"));
    const std::vector<std::string>& last = rows.back();
    // However it was cut into slices, the samples are the same.
    REQUIRE(s.run({"tiny.xml", "--seed", "5", "--spp", last[3], "-o", "plain.exr", "-q"}).code ==
            0);
    const auto j =
        nlohmann::json::parse(s.run({"compare", "plain.exr", "reference.exr", "--json"}).out);
    CHECK(double(j["rmse"]) == doctest::Approx(std::stod(last[4])).epsilon(0.03));
    CHECK(double(j["trimmed"]) == doctest::Approx(std::stod(last[6])).epsilon(0.05));
  }

  TEST_CASE("several scenes, and a reference of their own") {
    const Studio s;
    std::filesystem::create_directory(s.path("box"));
    s.write("box/scene.xml", lamp_scene().text());
    const Outcome o = s.chart({"tiny.xml", "box/scene.xml", "-i", "path,vcm", "--time", "0.8", "-o",
                               "all", "--reference-integrator", "path"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "there is no --reference; one is made with path"));
    const std::string page = s.file("all/index.html");
    CHECK(contains(page, "href=\"tiny/index.html\""));
    CHECK(contains(page, "href=\"box/index.html\""));
    CHECK(occurrences(page, "<svg") == 2);
    CHECK(occurrences(page, ">made by Duet itself with path in ") == 2);
    const std::string box = s.file("all/box/index.html");
    CHECK(contains(box, "made by Duet itself with path"));
    CHECK(contains(box, "what this method cannot see or gets wrong is missing in it"));
    const Rows rows = csv(s.file("all/summary.csv"));
    REQUIRE(rows.size() == 5);
    CHECK(rows[0].back() == "reference");
    CHECK(contains(rows[1][9], "made by Duet itself with path"));
    CHECK(rows[1][0] == "tiny");
    CHECK(rows[4][0] == "box");
    CHECK(rows[4][1] == "vcm");
    double best = 0;
    // An image that is as good as the reference has no efficiency.
    for (size_t i = 1; i < 3; ++i)
      if (!rows[i][8].empty()) best = std::max(best, std::stod(rows[i][8]));
    CHECK(best == 1);
    // The reference that was made can be given.
    CHECK(s.chart({"tiny.xml", "-i", "path", "--time", "0.2", "-o", "again", "--reference",
                   "all/tiny/reference.exr", "--variance", "all/tiny/reference-variance.exr"})
              .code == 0);
    CHECK(contains(s.file("again/index.html"), "its variance subtracted"));
    CHECK(contains(s.file("again/index.html"),
                   "all/tiny/reference.exr (made by Duet itself with path in "));
  }

  TEST_CASE("the summary says how each reference was made") {
    const Studio s;
    const Image image = read_image(s.path("reference.exr")).image;
    const auto write = [&](const char* name,
                           std::vector<std::pair<std::string, HeaderValue>> header) {
      ExrOptions options;
      options.header = std::move(header);
      write_exr(s.path(name), image, options);
    };
    write("tiny-b.exr", {{"generatedBy", std::string("Mitsuba version 3.5")}, {"spp", 77}});
    write("tiny-c.exr", {});
    std::filesystem::copy(s.path("reference.exr"), s.path("tiny-a.exr"));
    for (const char* name : {"a.xml", "b.xml", "c.xml"}) s.write(name, lamp_scene().text());
    REQUIRE(s.chart({"a.xml", "b.xml", "c.xml", "-i", "path", "--time", "0.1", "-o", "all",
                     "--reference", "tiny-{scene}.exr"})
                .code == 0);
    const std::string page = s.file("all/index.html");
    CHECK(contains(page,
                   "tiny-a.exr (made by Duet " DUET_VERSION " path, 512 samples per pixel, in "));
    CHECK(contains(page, "tiny-b.exr (made by Mitsuba version 3.5, 77 samples per pixel)"));
    CHECK(contains(page, "tiny-c.exr (its header does not say how it was made)"));
    // One method alone is the best of none.
    CHECK(occurrences(page, "<td class=\"best\"") == 0);
  }

  TEST_CASE("the size is that of the reference") {
    const Studio s;
    REQUIRE(s.run({"tiny.xml", "--size", "32x24", "-o", "large.exr", "-q"}).code == 0);
    REQUIRE(s.run({"tiny.xml", "--size", "32x32", "-o", "square.exr", "-q"}).code == 0);
    const Outcome o = s.chart(
        {"tiny.xml", "-i", "path", "--time", "0.2", "-o", "out", "--reference", "large.exr"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "rendered at 32x24, the size of the reference"));
    const Outcome other = s.chart(
        {"tiny.xml", "-i", "path", "--time", "0.2", "-o", "out", "--reference", "square.exr"});
    CHECK(other.code == 1);
    CHECK(contains(other.err, "the image is 16x12, the reference 32x32"));
    CHECK(s.chart({"tiny.xml", "-i", "path", "--time", "0.2", "-o", "out", "--reference",
                   "large.exr", "--size", "16x12"})
              .code == 1);
  }

  TEST_CASE("external renderers are timed and trusted with nothing") {
    const Studio s;
    const auto external = [&](const std::string& command) {
      return s.chart({"tiny.xml", "-i", "path", "--external", command, "--time", "4s",
                      "--reference", "reference.exr", "-o", "out"});
    };
    const Outcome fine =
        external(std::string("other=") + program_path() + " {scene} --spp {spp} -o {out} -q");
    CHECK(fine.code == 0);
    const Rows rows = csv(s.file("out/chart.csv"));
    int expected = 1;
    for (const auto& row : rows)
      if (row[0] == "other") {
        CHECK(std::stoi(row[3]) == expected);
        expected *= 2;
        CHECK(std::stod(row[2]) > 0);
      }
    CHECK(expected >= 4);
    CHECK_FALSE(s.has("out/external-output.exr"));

    const Outcome fails = external("other=echo {spp} {out}; exit 7");
    CHECK(fails.code == 1);
    CHECK(contains(fails.err, "other ended early, at 1 spp: it ended with exit code 7"));
    CHECK(contains(s.file("out/index.html"), "exit code 7"));
    CHECK(csv(s.file("out/chart.csv")).back()[0] == "path");
    CHECK(contains(external("other=true {spp} {out}").err, "cannot be opened"));
    const Outcome slow = external("other=cp reference.exr {out}; sleep 600; echo {spp}");
    CHECK(slow.code == 1);
    CHECK(slow.seconds < 300);  // it was ended
    CHECK(contains(slow.err, "did not end within its share"));
    CHECK_FALSE(s.has("out/external-output.exr"));
    CHECK(s.chart({"tiny.xml", "--external", "other=render {out}"}).code == 2);
    CHECK(s.chart({"tiny.xml", "--external", "render {spp} {out}"}).code == 2);
    CHECK(external("other=render {spp} {out} {speed}").code == 2);
  }

  TEST_CASE("an interrupted chart has what there was") {
    const Studio s;
    Process p({"chart", "tiny.xml", "-i", "path", "--time", "1h", "--reference", "reference.exr",
               "-o", "out"},
              {.directory = s.path("")});
    CHECK(p.wait_for_message("path", 120));
    p.send(SIGINT);
    CHECK(p.wait(120).code == 130);
    CHECK(csv(s.file("out/chart.csv")).size() > 2);
    CHECK(contains(s.file("out/index.html"), "</html>"));
  }

  TEST_CASE("charts that cannot be made") {
    const Studio s;
    const std::vector<std::string> quick{"tiny.xml", "--time", "0.1", "-o", "out"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), quick.begin(), quick.end());
      return s.chart(more);
    };
    struct Case {
      std::vector<std::string> arguments;
      int code;
      std::string message;
    };
    const std::vector<Case> cases{
        {{"-i", "pth"}, 2, "did you mean \"path\""},
        {{"-i", "path,path"}, 2, "was given twice"},
        {{"-i", "max_depth=3"}, 2, "is a parameter of no method"},
        {{"-i", "path,,vcm"}, 2, "name of a method is missing"},
        {{"-i", "path:depth=3"}, 2, "has no parameter \"depth\""},
        {{"-i", "depth"}, 2, "no colours"},
        {{"-i", "aov"}, 2, "no colours"},
        {{"-i", "vcm"}, 2, "--reference-integrator"},
        {{"-I", "speed=3"}, 2, "speed"},
        {{"--time", "soon"}, 2, "--time"},
        {{"--size", "4x4"}, 2, "--size"},
        {{"-s", "3"}, 2, "-s 3"},
        {{"--variance", "reference.exr"}, 2, "--variance"},
        {{"--reference", "missing.exr"}, 1, "missing.exr"},
        {{"--reference", "tiny.xml"}, 1, "tiny.xml"},
        {{"--reference", "{name}.exr"}, 2, "only {scene} and {folder}"},
        {{"--reference", "reference.exr", "--reference", "reference.exr"}, 2, "given 2 times"},
        {{"-o", "tiny.xml"}, 2, "cannot be made a directory"},
        {{"other.xml"}, 1, "other.xml"},
    };
    for (const Case& c : cases) {
      CAPTURE(c.message);
      // The last of several -o counts for none: replace the first.
      Outcome o = c.arguments[0] == "-o" || c.arguments[0] == "--time"
                      ? s.chart({"tiny.xml", c.arguments[0], c.arguments[1]})
                      : with(c.arguments);
      CHECK(o.code == c.code);
      CHECK(contains(o.err, c.message));
    }
    CHECK(s.chart({}).code == 2);
    CHECK(s.chart({"missing.xml", "--time", "0.1"}).code == 1);
    Image holes = read_image(s.path("reference.exr")).image;
    holes.data[3] = NAN;
    write_exr(s.path("nan.exr"), holes, {});
    const Outcome nan = with({"--reference", "nan.exr"});
    CHECK(nan.code == 1);
    CHECK(contains(nan.err, "not finite"));
  }

  TEST_CASE("the page works in a browser") {
    const std::string program = browser();
    if (program.empty()) {
      MESSAGE("skipped: DUET_BROWSER is none");
      return;
    }
    const Studio s;
    const Outcome made = s.chart({"tiny.xml", "-i", "path,vcm", "--time", "0.4", "--reference",
                                  "reference.exr", "-o", "out"});
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    // What a user would do.
    const std::string actions = R"(
      const errors = [];
      addEventListener("error", (e) => errors.push(e.message));
      const root = document.querySelector(".viewer"), seen = [root.dataset.shown];
      const rgba = (x, y, w, h) =>
        [...root.viewer.source.getContext("2d").getImageData(x, y, w, h).data];
      const pixel = () => rgba(8, 6, 1, 1).join();
      // Of the whole image: one pixel may be right by chance.
      const black_image = () => rgba(0, 0, 16, 12).every((v, i) => v === (i % 4 === 3 ? 255 : 0));
      const key = (k) => root.dispatchEvent(new KeyboardEvent("keydown", {key: k, bubbles: true}));
      key(" "); seen.push(root.dataset.shown);
      key(" "); seen.push(root.dataset.shown);
      key("2"); seen.push(root.dataset.shown);
      const before = pixel();
      root.viewer.set_exposure(-3);
      const darker = pixel() !== before;
      key("r");
      const restored = pixel() === before;
      key("3"); key("e");
      const black = black_image();
      key("1");
      root.viewer.set_exposure(6);
      const coloured = !black_image();
      key("f");
      const flip = !black_image() && root.querySelector(".scale").textContent.startsWith("FLIP");
      key("3");
      const flip_of_reference = black_image();
      key("f");
      const toggle = [...root.querySelectorAll("button")].map((b) => b.textContent)
        .filter((t) => t.startsWith("toggle"));
      root.viewer.scale(4);
      // A canvas is 300 pixels wide before the viewer makes it as wide as its place in the layout.
      const canvas = root.viewer.canvas;
      const fitted = () => canvas.width !== 300 &&
        canvas.width === Math.round(canvas.clientWidth * devicePixelRatio);
      const root_style = document.documentElement.style;
      root_style.width = "1100px";
      const fits = [...document.querySelectorAll(".scroll")]
        .every((e) => e.scrollWidth <= e.clientWidth);
      root_style.width = "";
      when(fitted, () => finish({fits, seen, darker, restored, black, coloured, flip, flip_of_reference,
                                 toggle, errors, zoom: root.viewer.zoom, width: canvas.width}));
    )";
    const DrivenPage page = drive_page(program, s.file("out/index.html"), actions, s.path("out"));
    CAPTURE(page.console);
    const auto result = nlohmann::json::parse(page.result);
    CHECK(result["seen"] == nlohmann::json{"path", "reference", "path", "vcm"});
    CHECK(result["darker"] == true);
    CHECK(result["restored"] == true);
    CHECK(result["black"] == true);  // the reference does not differ from itself
    CHECK(result["coloured"] == true);
    CHECK(result["fits"] == true);
    CHECK(result["flip"] == true);
    CHECK(result["flip_of_reference"] == true);
    CHECK(result["toggle"] == nlohmann::json{"toggle to path"});
    CHECK(result["zoom"] == 4);
    CHECK(int(result["width"]) > 100);
    CHECK(result["errors"].empty());
    // The browser's advice about reading pixels is for this test, which alone does that.
    std::istringstream console(page.console);
    for (std::string line; std::getline(console, line);)
      CHECK(contains(line, "willReadFrequently"));
  }
}
