#include "evaluate/stability/catalogue.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/files.h"

using namespace duet;
using namespace duet::stability;
using namespace duet::test;

namespace {

using nlohmann::json;

/// A folder with a scene "ball" and a catalogue.
struct Folder : TemporaryDirectory {
  Folder() {
    std::filesystem::create_directory(path("ball"));
    write("ball/scene.xml", "");
  }
  Catalogue read(const json& rows) const {
    write("catalogue.json", rows.dump());
    return read_catalogue(path(""));
  }
  static json row() {
    return {{"name", "ball"},
            {"title", "A white ball is seen"},
            {"check", "energy"},
            {"scene", "ball"},
            {"spp", 8},
            {"reference", {{"value", 1}}},
            {"methods", {{"*", "holds"}}}};
  }
};

/// Why a catalogue cannot be used; "" if it can.
template <class Read>
std::string failure(Read read) {
  try {
    read();
    return "";
  } catch (const CatalogueError& e) {
    return e.what();
  }
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a catalogue is read with what it leaves open") {
  const Folder folder;
  json row = Folder::row();
  row["methods"]["bdpt"] = {{"not applicable", "said so"}};
  row["parameters"] = {{"*", {{"max_depth", 4}}}, {"vcm", {{"radius", 0.5}}}};
  const Catalogue c = folder.read(json::array({row}));
  REQUIRE(c.rows.size() == 1);
  CHECK(c.rows[0].methods.at("bdpt").verdict == Expected::not_applicable);
  CHECK(c.rows[0].methods.at("vcm").verdict == Expected::holds);
  CHECK(settings_for(c.rows[0].parameters, "vcm") ==
        Settings{{"max_depth", "4"}, {"radius", "0.5"}});
  // All but bdpt, and auto, which runs one of the others.
  CHECK(c.measured_cells() == int(kMethods.size()) - 2);
}

TEST_CASE("mistakes in a catalogue are named") {
  const Folder folder;
  const auto refused = [&](const char* key, const json& value, const char* named) {
    json row = Folder::row();
    row[key] = value;
    const std::string why = failure([&] { folder.read(json::array({row})); });
    CAPTURE(why);
    CHECK(has(why, named));
  };
  refused("limmit", 1, "unknown key \"limmit\" (did you mean \"limit\"?)");
  refused("check", "energi", "did you mean \"energy\"?");
  refused("scene", "bal", "there is no scene");
  refused("spp", "many", "\"spp\" has the wrong type");
  refused("spp", 0, "\"spp\"");
  refused("methods", json{{"path", "holds"}}, "nothing is expected of \"ptracer\"");
  refused("methods", json{{"*", "holds"}, {"paht", "holds"}}, "did you mean \"path\"?");
  refused("methods", json{{"*", {{"fails", {1, 0}}, {"why", "?"}}}}, "\"fails\" needs");
  refused("methods", json{{"*", {{"fails", {0, 1}}}}}, "\"why\" is missing");
  refused("reference", json::object(), "needs a reference");
  refused("limit", 0.05, "check \"energy\" has no limit");
  refused("tiles", 0, "\"tiles\"");
  refused("target_error", "little", "\"target_error\" has the wrong type");
  refused("region", {0, 0, 2, 1}, "\"region\" needs");
  refused("number", "x", "\"number\" has the wrong type");
  const json two = json::array({Folder::row(), Folder::row()});
  CHECK(has(failure([&] { folder.read(two); }), "two rows are called \"ball\""));
  folder.write("catalogue.json", "[{");
  CHECK(has(failure([&] { read_catalogue(folder.path("")); }), "catalogue.json"));
}
