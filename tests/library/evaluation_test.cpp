// Charts and stability tables of the library: those of the program, without files.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "duet/duet.h"
#include "support/stability_catalogue.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A scene with noise: a lamp with area.
SceneFile lamp_scene(const Workplace& place) {
  TinyScene scene;
  scene.extra = R"(<shape type="sphere"><point name="center" x="0.5" y="0.5" z="1"/>
    <float name="radius" value="0.3"/><emitter type="area"/></shape>)";
  return SceneFile::load(place.scene("tiny.xml", scene));
}

size_t files_in(const Workplace& place) {
  return size_t(std::distance(std::filesystem::directory_iterator(place.path("")), {}));
}

/// The current folder is another one for a while.
struct Inside {
  explicit Inside(const Workplace& place) { std::filesystem::current_path(place.path("")); }
  ~Inside() { std::filesystem::current_path(before); }
  std::filesystem::path before = std::filesystem::current_path();
};

/// Two rows: one that holds, and one that fails where it should hold.
std::string catalogue(const Workplace& place) {
  std::filesystem::create_directory(place.path("ball"));
  place.write("ball/scene.xml", kBallScene);
  const nlohmann::json white = ball_row();
  nlohmann::json grey = white;
  grey["name"] = "grey", grey["define"] = {{"albedo", 0.5}};
  place.write("catalogue.json", nlohmann::json::array({white, grey}).dump());
  return place.path("");
}

/// What does not depend on the clock.
nlohmann::json without_seconds(const std::string& text) {
  nlohmann::json rows = nlohmann::json::parse(text);
  for (nlohmann::json& row : rows)
    for (nlohmann::json& cell : row["cells"]) cell.erase("seconds");
  return rows;
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("the library's charts have points, fits and the program's page") {
    const Workplace place;
    const SceneFile scene = lamp_scene(place);
    RenderSettings best;
    best.spp = 512;
    render_file(scene, best)->save(place.path("reference.exr"));
    const size_t files = files_in(place);
    ChartSettings settings;
    settings.methods = {{"path", {{"max_depth", "3"}}, "short paths"}, {"bdpt", {}, ""}};
    settings.seconds = 0.3;
    settings.reference = place.path("reference.exr");
    const MethodChart chart = chart_file(scene, settings).value();
    REQUIRE(chart.lines().size() == 2);
    CHECK(chart.lines()[0].name == "short paths");
    CHECK(chart.lines()[1].name == "bdpt");
    CHECK(contains(chart.lines()[0].parameters, "max_depth=3"));
    CHECK(chart.width() == 16);
    CHECK(chart.height() == 12);
    CHECK(contains(chart.reference(), "reference.exr"));
    for (const ChartedLine& line : chart.lines()) {
      REQUIRE(line.points.size() > 1);
      CHECK(line.failure == "");
      CHECK(line.points.front().spp < line.points.back().spp);
      CHECK(line.points.back().trimmed <= line.points.back().relmse);
      if (line.efficiency) CHECK(line.efficiency->low <= line.efficiency->value);
    }
    // A line of names, and one for each point.
    const std::string csv = chart.csv();
    CHECK(size_t(std::count(csv.begin(), csv.end(), '\n')) ==
          1 + chart.lines()[0].points.size() + chart.lines()[1].points.size());
    CHECK(chart.svg().starts_with("<svg"));
    CHECK(chart.svg_of_samples() != chart.svg());
    CHECK(contains(chart.page("my <program>"), "<pre>my &lt;program&gt;</pre>"));
    // A reference that is made is no file.
    const Inside inside(place);
    settings.reference = "";
    CHECK(contains(chart_file(scene, settings)->reference(), "made by Duet itself with bdpt"));
    CHECK(files_in(place) == files);
  }

  TEST_CASE("the library's charts: what cannot be asked for, and cancellation") {
    const Workplace place;
    const SceneFile scene = lamp_scene(place);
    ChartSettings settings;
    CHECK_THROWS_AS(chart_file(scene, settings), std::invalid_argument);  // no methods
    settings.methods = {{"pathh", {}, ""}};
    CHECK_THROWS_WITH_AS(chart_file(scene, settings), doctest::Contains("pathh"),
                         std::invalid_argument);
    settings.methods = {{"path", {}, ""}};
    settings.seconds = 0;
    CHECK_THROWS_AS(chart_file(scene, settings), std::invalid_argument);
    settings.seconds = 0.1;
    settings.reference = place.path("nothing.exr");
    CHECK_THROWS_AS(chart_file(scene, settings), FileError);
    settings.reference = "";
    settings.sensor = 1;
    CHECK_THROWS_AS(chart_file(scene, settings), std::out_of_range);
    settings.sensor = 0;
    const std::atomic<bool> stop{true};
    ChartWatch watch;
    watch.cancel = &stop;
    CHECK(!chart_file(scene, settings, watch));
  }

  TEST_CASE("the library's stability table is that of the program") {
    const Workplace place;
    StabilitySettings settings;
    settings.catalogue = catalogue(place);
    settings.methods = {"path", "bdpt"};
    std::vector<std::string> judged;
    StabilityWatch watch;
    watch.judged = [&](const StabilityCell& c) { judged.push_back(c.row + " " + c.method); };
    const StabilityTable table = check_stability(settings, watch).value();
    CHECK(judged == std::vector<std::string>{"ball path", "ball bdpt", "grey path", "grey bdpt"});
    REQUIRE(table.cells().size() == 4);
    CHECK(table.cells()[0].verdict == StabilityVerdict::holds);
    CHECK(table.cells()[0].notices <= table.cells()[0].has_to_notice);
    CHECK(table.cells()[3].verdict == StabilityVerdict::unexpected);
    CHECK(table.cells()[3].value < -0.1);
    CHECK(!table.is_as_expected());
    CHECK(table.summary() == "2 of 4 cells as expected\n");
    const Outcome o = place.run({"stability", "--catalogue", ".", "--methods", "path,bdpt",
                                 "--json", "program.json", "--html", "program.html"});
    CHECK(o.code == 1);
    CHECK(without_seconds(table.json()) == without_seconds(read_file(place.path("program.json"))));
    const std::string page = read_file(place.path("program.html"));
    const size_t command = page.find("<pre>duet stability");
    REQUIRE(command != std::string::npos);
    CHECK(table.page("mine").substr(0, command) == page.substr(0, command));
    // One row by its number, and what there is not.
    settings.rows = {"19"};
    settings.methods = {"vcm"};
    CHECK(check_stability(settings)->cells().size() == 2);
    settings.rows = {"20"};
    CHECK_THROWS_AS(check_stability(settings), std::invalid_argument);
    settings.rows = {}, settings.methods = {"bdtp"};
    CHECK_THROWS_WITH_AS(check_stability(settings), doctest::Contains("did you mean \"bdpt\"?"),
                         std::invalid_argument);
    settings.methods = {}, settings.catalogue = place.path("nowhere");
    CHECK_THROWS_AS(check_stability(settings), FileError);
    const std::atomic<bool> stop{true};
    watch.cancel = &stop;
    settings.catalogue = "";  // Duet's own
    CHECK(!check_stability(settings, watch));
  }
}
