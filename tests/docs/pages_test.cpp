// What the pages of docs/ list is what there is.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "support/files.h"
#include "support/source_path.h"

using namespace duet::test;

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = fs::path(source_path("")).parent_path();

std::string page(const std::string& name) {
  return read_file((kRoot / "docs" / name).string());
}

/// What the first group of an expression matches, everywhere in a text.
std::vector<std::string> matches(const std::string& text, const std::string& expression) {
  const std::regex regex(expression);
  std::vector<std::string> found;
  for (std::sregex_iterator m(text.begin(), text.end(), regex), end; m != end; ++m)
    found.push_back((*m)[1]);
  return found;
}

/// Whether a folder of reference/ is from pbrt; the others are from Mitsuba.
bool is_pbrt(const fs::path& reference) {
  return reference.filename().string().starts_with("pbrt-");
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

/// "16,384"
std::string with_commas(int number) {
  std::string digits = std::to_string(number);
  for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(size_t(at), ",");
  return digits;
}

/// Folders with sources, as "src/evaluate/stability".
void add_rooms(const fs::path& folder, std::set<std::string>& rooms) {
  for (const fs::path& path : entries(folder)) {
    if (fs::is_directory(path)) add_rooms(path, rooms);
    if (path.extension() == ".cpp" || path.extension() == ".h")
      rooms.insert(folder.lexically_relative(kRoot).string());
  }
}

}  // namespace

TEST_CASE("every file that a page names, or refers to, is there") {
  int named = 0;
  for (const fs::path& path : entries(kRoot / "docs")) {
    if (path.extension() != ".md") continue;
    const std::string text = read_file(path.string());
    INFO(path.filename().string());
    const std::string rooms = "(?:src|parsers|tests|bench|scripts|docs|scenes|reference)/";
    for (const std::string& file : matches(text, "`(" + rooms + "[^`\n <>{}*$]*)[` ]")) {
      INFO(file);
      CHECK(fs::exists(kRoot / file));
      ++named;
    }
    for (const std::string& link : matches(text, "\\]\\(([^)#]+)[^)]*\\)")) {
      if (link.find("://") != link.npos) continue;
      INFO(link);
      CHECK(fs::exists(path.parent_path() / link));
    }
  }
  CHECK(named > 150);
}

TEST_CASE("the reading order leads into every room") {
  std::set<std::string> rooms;
  add_rooms(kRoot / "src", rooms);
  add_rooms(kRoot / "parsers", rooms);
  REQUIRE(rooms.size() > 15);
  const std::string text = page("reading_order.md");
  for (const std::string& room : rooms) {
    INFO(room);
    // A file in the room itself, or the room.
    CHECK(!matches(text, "`(" + room + "/(?:[^`/ ]+\\.[a-z]+)?)[` ]").empty());
  }
}

TEST_CASE("the files of the notation have the identifiers and the types") {
  int rows = 0;
  for (const std::string& row : matches(page("notation.md"), "\\n(\\| [^\\n]*` \\| `[^\\n]*)")) {
    const std::vector<std::string> cells = matches(row, "\\| ([^|]*[^| ])?(?= \\|)");
    REQUIRE(cells.size() >= 4);
    INFO(row);
    const std::string text = read_file((kRoot / matches(cells[3], "`(.*)`").at(0)).string());
    for (const std::string& name : matches(cells[1] + cells[2], "`([^`]*)`"))
      CHECK(!matches(text, "(\\b" + name + "\\b)").empty());
    ++rows;
  }
  CHECK(rows > 25);
}

TEST_CASE("the table of pbrt's scenes is what their provenance says") {
  std::string table;
  for (const fs::path& reference : entries(kRoot / "reference")) {
    if (!is_pbrt(reference)) continue;
    const auto p = nlohmann::json::parse(read_file((reference / "provenance.json").string()));
    table += fmt::format(
        "| `{}` | {} | {} | {} |\n", reference.filename().string(), p["shows"].get<std::string>(),
        p["light_transport_class"].get<std::string>(), with_commas(p["spp"].get<int>()));
  }
  // All of the rows, and no others.
  CHECK(page("pbrt_scenes.md").find("|---|---|---|---|\n" + table + "\n") != std::string::npos);
}

TEST_CASE("the tables of references have every scene and what the provenance of each image says") {
  const std::string text = page("references.md");
  for (const fs::path& scene : entries(kRoot / "scenes")) {
    if (!fs::exists(scene / "scene.xml") && !fs::exists(scene / "scene-0.6.xml")) continue;
    INFO(scene.string());
    CHECK(text.find(fmt::format("\n| `{}` | ", scene.filename().string())) != text.npos);
  }
  std::string table;
  for (const fs::path& reference : entries(kRoot / "reference")) {
    if (!fs::exists(reference / "mean.exr") || is_pbrt(reference)) continue;
    const auto p = nlohmann::json::parse(read_file((reference / "provenance.json").string()));
    table += fmt::format("| `{}` | {} × {} | {} | {:.2f} % |\n", reference.filename().string(),
                         p["size"][0].get<int>(), p["size"][1].get<int>(),
                         with_commas(p["spp"].get<int>()),
                         100 * p["trimmed_relative_rmse"].get<double>());
  }
  const std::string head = "|---|---|---|---|\n";
  const size_t begin = text.find(head);
  REQUIRE(begin != text.npos);
  const size_t first = begin + head.size();
  CHECK(text.substr(first, text.find("\n\n", first) + 1 - first) == table);
}

TEST_CASE("both tables of fuzzing have every fuzzer") {
  std::vector<std::string> twice;
  for (const fs::path& file : entries(kRoot / "tests" / "fuzz"))
    if (file.extension() == ".cpp") twice.insert(twice.end(), 2, file.stem().string());
  REQUIRE(twice.size() > 10);
  std::vector<std::string> listed = matches(page("fuzzing.md"), "\n\\| `(fuzz_[a-z]+)`");
  std::sort(listed.begin(), listed.end());
  CHECK(listed == twice);
}
