// Broken files: each gives an error with its place, in good time and with little memory.
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <sstream>

#include "scene/build.h"
#include "support/files.h"
#include "support/memory_scene.h"
#include "support/source_path.h"
#include "values/text.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kFolder = source_path("tests/broken/");

/// A line of tests/broken/expected.txt: `file | stage | message`.
struct Expectation {
  std::string file, stage, message;
};

std::vector<Expectation> expectations() {
  std::istringstream in(read_file(kFolder + "expected.txt"));
  std::vector<Expectation> all;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t first = line.find('|'), second = line.find('|', first + 1);
    REQUIRE_MESSAGE(second != line.npos, line);
    const auto part = [&](size_t begin, size_t end) {
      return std::string(trim(std::string_view(line).substr(begin, end - begin)));
    };
    all.push_back({part(0, first), part(first + 1, second), part(second + 1, line.size())});
  }
  return all;
}

/// A scene that uses a mesh or image file.
std::string scene_around(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string().substr(1);
  const std::string name = "\n<string name='filename' value='" + file + "'/>";
  const std::string content =
      extension == "png" || extension == "exr"
          ? "<shape type='sphere'><bsdf type='diffuse'><texture type='bitmap' name='reflectance'>" +
                name + "</texture></bsdf></shape>"
          : "<shape type='" + extension + "'>" + name + "</shape>";
  return scene_text("3.0.0", "<emitter type='constant'/>" + content);
}

long peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// Reads and builds a scene; all errors and warnings with the folders taken away.
class Attempt {
 public:
  Attempt(const std::string& file, const std::string& folder, const MitsubaOptions& options = {}) {
    const auto start = std::chrono::steady_clock::now();
    const long before = peak_megabytes();
    auto scene = read_mitsuba(file, options, diagnostics_);
    was_read_ = scene.has_value();
    if (was_read_)
      was_built_ = build_scene(std::move(scene->description), {}, diagnostics_) != nullptr;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    CHECK(seconds.count() < 20);
    CHECK(peak_megabytes() - before < 1000);
    for (const Diagnostic& d : diagnostics_.all()) {
      // A place that one can go to, in a message that one can read.
      CHECK(d.where.file);
      // A value of the command line has no line; the file is named beside it.
      const bool is_define = d.where.file->starts_with("-D ");
      CHECK((d.where.line > 0) != is_define);
      CHECK((d.where.column > 0) != is_define);
      CHECK(d.message.size() < 2000);
      messages_ += d.to_string() + "\n";
    }
    for (const std::string& prefix : {folder, kFolder})
      for (size_t at; (at = messages_.find(prefix)) != messages_.npos;)
        messages_.erase(at, prefix.size());
  }

  /// Where it ended: read (the reader refused it), build, or warning.
  std::string stage() const { return !was_read_ ? "read" : was_built_ ? "warning" : "build"; }
  const std::string& messages() const { return messages_; }
  bool has(const std::string& text) const { return messages_.find(text) != messages_.npos; }

 private:
  Diagnostics diagnostics_;
  bool was_read_ = false, was_built_ = false;
  std::string messages_;
};

/// A file made here and now, because it is too large to keep.
Attempt attempt_text(const std::string& text, const MitsubaOptions& options = {}) {
  const TemporaryDirectory folder;
  return Attempt(folder.write("scene.xml", text), folder.path(""), options);
}

}  // namespace

TEST_CASE("broken files: each one is refused with the place and the reason") {
  const TemporaryDirectory folder;
  std::set<std::string> known{"expected.txt"};
  size_t broken = 0;
  for (const Expectation& e : expectations()) {
    known.insert(e.file);
    if (e.stage == "part") continue;  // of another one
    ++broken;
    const std::string file = e.file.ends_with(".xml")
                                 ? kFolder + e.file
                                 : folder.write("scene.xml", scene_around(kFolder + e.file));
    const Attempt attempt(file, folder.path(""));
    INFO(e.file, "\n", attempt.messages());
    CHECK(attempt.stage() == e.stage);
    CHECK(!e.message.empty());
    CHECK_MESSAGE(attempt.has(e.message), e.message);
  }
  CHECK(broken >= 60);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    CHECK_MESSAGE(known.count(entry.path().filename().string()) == 1, entry.path().string());
}

TEST_CASE("broken files: nesting without end") {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<bsdf type='twosided'>";
  CHECK(attempt_text(scene_text("3.0.0", deep)).has("this is not well-formed XML"));
  for (int i = 0; i < 100000; ++i) deep += "</bsdf>";
  CHECK(attempt_text(scene_text("3.0.0", deep)).has("nested more than 64 deep"));
}

TEST_CASE("broken files: a chain of references without end") {
  std::string chain = "<bsdf type='diffuse' id='m0'/>";
  for (int i = 1; i < 20000; ++i)
    chain += fmt::format("<bsdf type='mask' id='m{}'><ref id='m{}'/></bsdf>\n", i, i - 1);
  CHECK(attempt_text(scene_text("3.0.0", chain)).stage() == "warning");
  // The other way round, each must be read within the one before.
  std::string back = "<bsdf type='diffuse' id='m20000'/>";
  for (int i = 0; i < 20000; ++i)
    back += fmt::format("<bsdf type='mask' id='m{}'><ref id='m{}'/></bsdf>\n", i, i + 1);
  CHECK(attempt_text(scene_text("3.0.0", back)).has("refer to one another more than 100 deep"));
}

TEST_CASE("broken files: files that include each other ten times over") {
  const TemporaryDirectory folder;
  for (int i = 0; i < 14; ++i) {
    std::string ten;
    for (int j = 0; j < 10; ++j) ten += fmt::format("<include filename='e{}.xml'/>", i + 1);
    folder.write(fmt::format("e{}.xml", i), "<scene version='3.0.0'>" + ten + "</scene>");
  }
  folder.write("e14.xml", "<scene version='3.0.0'/>");
  const Attempt attempt(folder.path("e0.xml"), folder.path(""));
  CHECK(attempt.has("more than 10000 files are included"));
}

TEST_CASE("broken files: parameters that grow without end") {
  std::string doubling = "<default name='a0' value='0123456789'/>\n";
  for (int i = 1; i < 60; ++i)
    doubling += fmt::format("<default name='a{}' value='$a{}$a{}'/>\n", i, i - 1, i - 1);
  CHECK(attempt_text(scene_text("3.0.0", doubling)).has("the value gets longer than 65536 bytes"));
}

TEST_CASE("broken files: huge values from the command line") {
  const std::string sphere = scene_text(
      "3.0.0",
      "<emitter type='constant'/><shape type='sphere'><float name='radius' value='$r'/></shape>");
  const auto with = [&](const std::string& value) {
    MitsubaOptions options;
    options.defines = {{"r", value}};
    return attempt_text(sphere, options);
  };
  CHECK(with("2").stage() == "warning");
  CHECK(with("1e300").stage() == "read");
  CHECK(with(std::string(20'000'000, '9')).stage() == "read");
  CHECK(with(std::string(1'000'000, '$')).stage() == "read");
  CHECK(with("\x1b[31m\n<sphere>").stage() == "read");
  CHECK(!with("\x1b[31m").has("\x1b"));
  // Names as many and as long as one likes.
  MitsubaOptions options;
  options.defines.emplace_back(std::string(10'000'000, 'r'), "1");
  for (int i = 0; i < 100'000; ++i) options.defines.emplace_back(fmt::format("r{}", i), "1");
  CHECK(attempt_text(sphere, options).has("undefined parameter"));
}

TEST_CASE("broken files: a scene cut anywhere is refused with a place") {
  const std::string text = read_file(source_path("scenes/two-versions/scene-0.6.xml"));
  const size_t whole = text.rfind("</scene>") + 8;
  for (size_t length = 0; length < whole; length += 7) {
    const Attempt attempt = attempt_text(text.substr(0, length));
    CAPTURE(length);
    CHECK(attempt.stage() == "read");
    CHECK(attempt.has("scene.xml:"));
  }
}
