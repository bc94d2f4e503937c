// Each broken pbrt file is refused with its place and the reason.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "pbrt/pbrt.h"
#include "support/files.h"
#include "support/source_path.h"
#include "values/text.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kBrokenPbrt = source_path("tests/broken_pbrt/");

/// All messages of a file, with the folder taken away.
std::string pbrt_messages(const std::string& file) {
  Diagnostics diagnostics;
  const auto scene = pbrt::read_pbrt(file, {}, diagnostics);
  CHECK(scene.has_value() != diagnostics.has_errors());
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += d.to_string() + "\n";
  for (size_t at; (at = text.find(kBrokenPbrt)) != text.npos;) text.erase(at, kBrokenPbrt.size());
  return text;
}

}  // namespace

TEST_CASE("broken pbrt files: each one is refused with the place and the reason") {
  // Lines `file | message`; several lines may be of one file.
  std::istringstream in(read_file(kBrokenPbrt + "expected.txt"));
  std::set<std::string> known{"expected.txt"};
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t bar = line.find('|');
    REQUIRE_MESSAGE(bar != line.npos, line);
    const std::string file(trim(std::string_view(line).substr(0, bar)));
    const std::string message(trim(std::string_view(line).substr(bar + 1)));
    known.insert(file);
    const std::string all = pbrt_messages(kBrokenPbrt + file);
    INFO(file, "\n", all);
    CHECK(!message.empty());
    CHECK_MESSAGE(all.find(message) != all.npos, message);
    CHECK(all.find("error: ") != all.npos);
  }
  CHECK(known.size() > 60);
  for (const auto& entry : std::filesystem::directory_iterator(kBrokenPbrt))
    CHECK_MESSAGE(known.count(entry.path().filename().string()) == 1, entry.path().string());
}

TEST_CASE("broken pbrt files: any cut of a scene ends in a message or a scene") {
  const std::string whole =
      "LookAt 0 -5 1 0 0 0 0 0 1\nCamera \"perspective\" \"float fov\" [40]\n"
      "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nWorldBegin\n"
      "Texture \"t\" \"float\" \"checkerboard\" \"float tex1\" .5\n"
      "AttributeBegin\nTranslate 1 2 3\nMaterial \"diffuse\" \"rgb reflectance\" [.1 .2 .3]\n"
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]\n"
      "AttributeEnd\n# end\nObjectBegin \"o\"\nShape \"sphere\"\nObjectEnd\nObjectInstance \"o\"\n";
  const TemporaryDirectory folder;
  size_t scenes = 0;
  for (size_t length = 0; length <= whole.size(); ++length) {
    Diagnostics diagnostics;
    const std::string file = folder.write("cut.pbrt", whole.substr(0, length));
    const auto scene = pbrt::read_pbrt(file, {}, diagnostics);
    CHECK(scene.has_value() != diagnostics.has_errors());
    scenes += scene.has_value();
  }
  CHECK(scenes > 0);
  CHECK(scenes < whole.size());
}

TEST_CASE("broken pbrt files: blocks without end") {
  std::string deep = "Film \"rgb\"\nWorldBegin\n";
  for (int i = 0; i < 200000; ++i) deep += "AttributeBegin\n";
  const TemporaryDirectory folder;
  Diagnostics diagnostics;
  CHECK(!pbrt::read_pbrt(folder.write("deep.pbrt", deep), {}, diagnostics));
  CHECK(diagnostics.summary().size() < 300);
}
