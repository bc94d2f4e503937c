// What the words of a pbrt file are, and where.
#include "pbrt/lexer.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include "pbrt/pbrt.h"
#include "support/files.h"

using namespace duet;
using namespace duet::test;
using pbrt::Kind;
using pbrt::Lexer;

TEST_CASE("pbrt lexer: words, strings, numbers and brackets with their places") {
  Lexer in("test", "Shape \"a b\" # comment \"no\"\n [1 -2.5e1 +.5]Translate");
  REQUIRE(in.peek() == Kind::word);
  CHECK(in.where().line == 1);
  CHECK(in.where().column == 1);
  CHECK(in.take_word() == "Shape");
  REQUIRE(in.peek() == Kind::string);
  CHECK(in.where().column == 7);
  CHECK(in.take_string() == "a b");
  REQUIRE(in.peek() == Kind::open);
  CHECK(in.where().line == 2);
  CHECK(in.where().column == 2);
  in.take_bracket();
  REQUIRE(in.peek() == Kind::number);
  std::vector<double> numbers;
  in.take_numbers(numbers);
  CHECK(numbers == std::vector<double>{1, -25, 0.5});
  REQUIRE(in.peek() == Kind::close);
  in.take_bracket();
  REQUIRE(in.peek() == Kind::word);
  CHECK(in.take_word() == "Translate");
  CHECK(in.peek() == Kind::end);
}

TEST_CASE("pbrt lexer: numbers that are none, and strings without end") {
  std::vector<double> numbers;
  for (const char* text : {"1.2.3", "1x", "--1", "1e99", "-"}) {
    Lexer in("test", text);
    REQUIRE(in.peek() == Kind::number);
    CHECK_THROWS_AS(in.take_numbers(numbers), pbrt::SyntaxError);
  }
  Lexer tiny("test", "1e-400");
  REQUIRE(tiny.peek() == Kind::number);
  numbers.clear();
  tiny.take_numbers(numbers);
  CHECK(numbers == std::vector<double>{0});
  Lexer open("test", "\"abc\ndef\"");
  REQUIRE(open.peek() == Kind::string);
  CHECK_THROWS_AS(open.take_string(), pbrt::SyntaxError);
}

TEST_CASE("pbrt lexer: files larger than a block, plain and gzipped, are the same") {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += std::to_string(i) + (i % 7 == 0 ? "\n" : " ");
  text += "\"end\"";
  const TemporaryDirectory folder;
  const std::string plain = folder.write("a.pbrt", text), packed = folder.path("b.pbrt.gz");
  const gzFile file = gzopen(packed.c_str(), "wb");
  gzwrite(file, text.data(), unsigned(text.size()));
  gzclose(file);
  for (const std::string& path : {plain, packed}) {
    Lexer in(path);
    std::vector<double> numbers;
    REQUIRE(in.peek() == Kind::number);
    in.take_numbers(numbers);
    REQUIRE(numbers.size() == 200000);
    for (size_t i = 0; i < numbers.size(); ++i)
      if (numbers[i] != double(i)) FAIL("wrong number at ", i);
    REQUIRE(in.peek() == Kind::string);
    CHECK(in.where().line == 1 + (200000 + 6) / 7);
    CHECK(in.take_string() == "end");
  }
}

TEST_CASE("pbrt versions are found from what a file uses") {
  const auto version = [](std::string_view text) {
    Lexer in("test", text);
    std::vector<std::string> includes;
    return int(pbrt::find_evidence(in, includes).value_or(pbrt::Version::v4));
  };
  CHECK(version("Film \"image\"") == 3);
  CHECK(version("Film \"rgb\" \"string filename\" \"image\"") == 4);
  CHECK(version("Camera \"perspective\" WorldBegin Material \"matte\"") == 3);
  CHECK(version("MakeNamedMaterial \"diffuse\" \"string type\" \"plastic\"") == 3);
  CHECK(version("MakeNamedMaterial \"plastic\" \"string type\" \"conductor\"") == 4);
  CHECK(version("LightSource \"point\" \"point from\" [1 2 3]") == 3);
  CHECK(version("LightSource \"point\" \"point3 from\" [1 2 3]") == 4);
  CHECK(version("WorldBegin WorldEnd") == 3);
  CHECK(version("LightSource \"infinite\" \"string mapname\" \"x.exr\"") == 3);
  CHECK(version("LightSource \"infinite\" \"integer samples\" 4") == 3);
  CHECK(version("AreaLightSource \"diffuse\" \"integer nsamples\" [4]") == 3);
  CHECK(version("MakeNamedMaterial \"a\" \"integer nsamples\" 2 \"string type\" "
                "\"coateddiffuse\"") == 4);
  CHECK(version("Sampler \"halton\" \"integer pixelsamples\" 4") == 4);
  CHECK(version("Texture \"u\" \"color\" \"constant\" \"rgb value\" [.2 .2 .2]") == 3);
  CHECK(version("Texture \"color\" \"spectrum\" \"constant\"") == 4);
  CHECK(version("Include \"mapname\" Shape \"sphere\"") == 4);
  CHECK(version("Attribute \"shape\" \"float radius\" 2") == 4);
  CHECK(version("") == 4);
}
