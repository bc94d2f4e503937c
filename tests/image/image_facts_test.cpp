// What files say about themselves, without their pixels.
#include "image/image_facts.h"

#include <doctest/doctest.h>

#include "image/image_io.h"
#include "support/files.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string long_text() {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "word " + std::to_string(i) + " ";
  return text;
}

}  // namespace

TEST_CASE("text fields of PNG and JPEG files come back, and pixels stay") {
  const TemporaryDirectory directory;
  const TextFields fields{{"program", "Duet"}, {"name", "caf\xc3\xa9"}, {"long", long_text()}};
  const std::vector<uint8_t> pixels(33 * 17 * 3, 100);
  for (const char* name : {"a.png", "a.jpg"}) {
    const std::string path = directory.path(name),
                      plain = directory.path("plain-" + std::string(name));
    write_display_image(path, 33, 17, 3, pixels, fields);
    write_display_image(plain, 33, 17, 3, pixels);
    CHECK(read_image(path).bytes == read_image(plain).bytes);
    const ImageFacts facts = read_image_facts(path);
    CHECK(facts.is_complete);
    CHECK(facts.field("program") == "Duet");
    CHECK(facts.field("name") == "caf\xc3\xa9");
    CHECK(facts.field("long") == long_text());
    CHECK(facts.field("none").empty());
    CHECK(read_image_facts(plain).field("program").empty());
  }
}

TEST_CASE("files tell the size of their images, and how they store numbers") {
  const TemporaryDirectory directory;
  const auto facts = [&](const char* name) { return read_image_facts(directory.path(name)); };
  const auto check = [](const ImageFacts& f, int channels, StoredNumbers numbers) {
    CHECK(f.width == 300);
    CHECK(f.height == 170);
    CHECK(f.channels == channels);
    CHECK(f.numbers == numbers);
  };
  constexpr size_t kPixels = 300 * 170;
  write_display_image(directory.path("a.png"), 300, 170, 3, std::vector<uint8_t>(3 * kPixels, 9));
  check(facts("a.png"), 3, StoredNumbers::bytes);
  write_display_image(directory.path("grey.png"), 300, 170, 2,
                      std::vector<uint8_t>(2 * kPixels, 9));
  check(facts("grey.png"), 2, StoredNumbers::bytes);
  directory.write("deep.png", [] {
    const auto bytes = display_image_bytes("deep.png", 300, 170, 1, std::vector<uint16_t>(kPixels));
    return std::string(bytes.begin(), bytes.end());
  }());
  check(facts("deep.png"), 1, StoredNumbers::others);
  write_display_image(directory.path("a.jpg"), 300, 170, 3, std::vector<uint8_t>(3 * kPixels, 9),
                      {{"program", "Duet"}});
  check(facts("a.jpg"), 3, StoredNumbers::bytes);
  const Image image(300, 170, {"R", "G", "B", "depth.T"});
  write_exr(directory.path("half.exr"), image, {});
  check(facts("half.exr"), 4, StoredNumbers::halves);
  ExrOptions options;
  options.full_precision = {"depth.T"};
  options.parts = true;
  write_exr(directory.path("depth.exr"), image, options);
  check(facts("depth.exr"), 4, StoredNumbers::others);
}

TEST_CASE("a file that has been cut off anywhere is not complete") {
  const TemporaryDirectory directory;
  Image image(40, 50, {"R", "G", "B"});
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % 977);
  ExrOptions exr;
  exr.header = {{"program", "Duet"}, {"spp", 7}};
  write_exr(directory.path("a.exr"), image, exr);
  exr.parts = true;
  Image layers(10, 40, {"R", "G", "B", "depth.T", "normal.X"});
  for (size_t i = 0; i < layers.data.size(); ++i) layers.data[i] = float(i % 977);
  write_exr(directory.path("parts.exr"), layers, exr);
  const TextFields fields{{"program", "Duet"}, {"spp", "7"}};
  const std::vector<uint8_t> pixels(40 * 50 * 3, 9);
  for (const char* name : {"a.png", "a.jpg"})
    write_display_image(directory.path(name), 40, 50, 3, pixels, fields);
  for (const char* name : {"a.exr", "parts.exr", "a.png", "a.jpg"}) {
    const ImageFacts facts = read_image_facts(directory.path(name));
    CHECK(facts.is_complete);
    CHECK(facts.field("program") == "Duet");
    CHECK(facts.field("spp") == "7");
    const std::string whole = read_file(directory.path(name));
    for (size_t n = 0; n<whole.size(); n += whole.size()> 2000 ? 53 : 7) {
      const std::string path = directory.write("cut", std::string_view(whole).substr(0, n));
      bool complete = false;
      try {
        complete = read_image_facts(path).is_complete;
      } catch (const ReadError&) {
      }
      CAPTURE(n);
      CHECK(!complete);
    }
    const std::string last =
        directory.write("cut", std::string_view(whole).substr(0, whole.size() - 1));
    CHECK(!read_image_facts(last).is_complete);
  }
}

TEST_CASE("what is no image has no facts") {
  const TemporaryDirectory directory;
  directory.write("empty", "");
  directory.write("text", "some text");
  for (const char* name : {"empty", "text", "missing", "."})
    CHECK_THROWS_AS(read_image_facts(directory.path(name)), ReadError);
}
