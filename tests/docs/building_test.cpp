// What docs/building.md says of presets and of other systems is true.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/source_path.h"

using namespace duet::test;

namespace {

namespace fs = std::filesystem;

std::string page() {
  return read_file(source_path("docs/building.md"));
}

}  // namespace

TEST_CASE("docs/building.md has all presets, and those of other systems are for these alone") {
  const auto presets = nlohmann::json::parse(read_file(source_path("CMakePresets.json")));
  size_t others = 0;
  for (const auto& preset : presets["configurePresets"]) {
    const std::string name = preset["name"];
    if (preset.value("hidden", false)) continue;
    CAPTURE(name);
    CHECK(page().find("| `" + name + "` |") != std::string::npos);
    if (name != "macos" && name != "windows") continue;
    ++others;
    CHECK(preset["inherits"] == "base");  // Ninja
    CHECK(preset["condition"]["lhs"] == "${hostSystemName}");
    CHECK(preset["condition"]["rhs"] == (name == "macos" ? "Darwin" : "Windows"));
  }
  CHECK(others == 2);
}

TEST_CASE("docs/building.md has all files that a port has to look at") {
  const std::string text = page();
  for (const auto& entry : fs::directory_iterator(source_path("src/base/system"))) {
    CAPTURE(entry.path().string());
    CHECK(text.find("`" + entry.path().stem().string() + "`") != std::string::npos);
  }
}
