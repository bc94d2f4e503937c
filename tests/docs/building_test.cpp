// What docs/building.md says of presets and of other systems is true.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/files.h"

using namespace duet::test;

namespace {

namespace fs = std::filesystem;

std::string page() {
  return read_file(DUET_SOURCE_DIR "/docs/building.md");
}

/// Whether a file includes headers that only POSIX has.
bool is_posix(const fs::path& file) {
  static const std::regex include(
      "#include <(unistd|sys/|poll|dlfcn|glob|spawn|fcntl|signal\\.h|netinet|arpa|netdb|termios|"
      "dirent|pthread|pwd|sched)");
  return std::regex_search(read_file(file.string()), include);
}

}  // namespace

TEST_CASE("docs/building.md has all presets, and those of other systems are for these alone") {
  const auto presets = nlohmann::json::parse(read_file(DUET_SOURCE_DIR "/CMakePresets.json"));
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

TEST_CASE("docs/building.md has all files that include headers of POSIX") {
  const std::string text = page();
  size_t files = 0;
  for (const char* folder : {"src", "parsers"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(DUET_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if ((extension != ".cpp" && extension != ".h") || !is_posix(entry.path())) continue;
      ++files;
      CAPTURE(entry.path().string());
      CHECK(text.find(entry.path().stem().string()) != std::string::npos);
    }
  CHECK(text.find(std::to_string(files) + " of the source files include headers of POSIX") !=
        std::string::npos);
}
