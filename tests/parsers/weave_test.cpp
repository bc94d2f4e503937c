// Descriptions of woven cloth, and what becomes of them.
#include "weave/weave.h"

#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kWeave = R"(/* two
     yarns */
weave {
  name = "Plain", // as linen
  tileWidth = 2, tileHeight = 2,
  alpha = 0.02, warpArea = $area,
  pattern { 1, 2,
            2, 2 },
  yarn { type = warp, psi = -30.5, kd = {0.1, 0.2, 0.4}, ks = 0.2 },
  yarn { type = weft, centerU = 0.5, kd = $dyed, ks = {0, 0, 0} },
})";

std::string failure(const std::string& text) {
  try {
    parse_weave(text, "a.wv");
  } catch (const ReadError& e) {
    return e.what();
  }
  return "";
}

/// The message for the weave with one of its parts replaced.
std::string failure_with(const std::string& part, const std::string& other) {
  std::string text = kWeave;
  text.replace(text.find(part), part.size(), other);
  return failure(text);
}

ReadResult cloth(const std::string& content, const std::string& weave = kWeave) {
  MemoryFiles files;
  files.texts["/scene/a.wv"] = weave;
  return read_scene("0.6.0",
                    "<bsdf type='irawan'><string name='filename' value='a.wv'/><float "
                    "name='repeatU' value='30'/>" +
                        content + "</bsdf>",
                    files);
}

}  // namespace

TEST_CASE("weave: yarns and cells") {
  const Weave w = parse_weave(kWeave, "a.wv");
  CHECK(w.pattern == std::vector<uint32_t>{0, 1, 1, 1});
  REQUIRE(w.yarns.size() == 2);
  CHECK(w.yarns[0].diffuse.value == Spectrum(0.1f, 0.2f, 0.4f));
  CHECK(w.yarns[0].specular.value == Spectrum(0.2f));
  CHECK(w.yarns[1].diffuse.parameter == "dyed");
  CHECK(w.yarns[1].specular.parameter.empty());
}

TEST_CASE("weave: mistakes have their place") {
  CHECK(failure("").starts_with("a.wv:1: a name is missing"));
  CHECK(failure("cloth {}").starts_with("a.wv:1: a description of a weave begins with"));
  CHECK(failure("weave {").find("a name is missing") != std::string::npos);
  CHECK(failure("weave { pattern { 1").find("a number is missing") != std::string::npos);
  CHECK(failure("weave {}").find("tileWidth") != std::string::npos);
  CHECK(failure("/* weave").find("a comment has no end") != std::string::npos);
  CHECK(failure(kWeave + " weave").find("after the end") != std::string::npos);
  CHECK(failure_with("\"Plain\"", "\"Plain").find("\"\"\" is missing") != std::string::npos);
  CHECK(failure_with("tileWidth = 2", "tileWidth = 0").starts_with("a.wv:5: the sides of a tile"));
  CHECK(
      failure_with("tileWidth = 2", "tileWidth = 1e9").starts_with("a.wv:5: the sides of a tile"));
  CHECK(failure_with("tileWidth = 2", "tileWidth = 3").find("has 4 cells, but a tile of 3 x 2") !=
        std::string::npos);
  CHECK(failure_with("{ 1, 2", "{ 0, 2").starts_with("a.wv:7: the cells of a pattern"));
  CHECK(failure_with("{ 1, 2", "{ 3, 2").find("names yarn 3 of 2") != std::string::npos);
  CHECK(failure_with("{0.1, 0.2", "{-0.1, 0.2").starts_with("a.wv:9: a colour has a negative"));
  CHECK(failure_with("{0.1, 0.2", "{1e99, 0.2").starts_with("a.wv:9: a colour has"));
  CHECK(failure_with("{0.1, 0.2, 0.4}", "{0.1, 0.2}").starts_with("a.wv:9: \",\" is missing"));
  CHECK(failure_with("psi = -30.5", "psi -30.5").starts_with("a.wv:9: \"=\" is missing"));
  CHECK(failure_with("psi = -30.5", "psi = nan").empty());  // a word
}

TEST_CASE("bsdf: irawan has the average colours of its yarns") {
  const ReadResult r = cloth("<rgb name='dyed' value='0.9, 0, 0'/>");
  REQUIRE(r.scene);
  CHECK(r.has("threads are not simulated"));
  CHECK_FALSE(r.has("unused"));
  const auto& m = r.description().materials.at(0).model.get<WardMaterial>();
  const Spectrum diffuse = std::get<Spectrum>(m.diffuse_reflectance);
  CHECK(diffuse.r == doctest::Approx(0.25 * 0.1 + 0.75 * 0.9));
  CHECK(diffuse.b == doctest::Approx(0.25 * 0.4));
  CHECK(std::get<Spectrum>(m.specular_reflectance).g == doctest::Approx(0.05));

  CHECK(cloth("").has("the weave needs the parameter \"dyed\""));
  CHECK(cloth("<string name='dyed' value='red'/>").has("must be a colour"));
  CHECK(cloth("<rgb name='dyed' value='-1, 0, 0'/>").has("negative"));
  CHECK(cloth("<float name='dyed' value='0.1'/><float name='other' value='1'/>").has("unused"));
  CHECK(cloth("<float name='ksMultiplier' value='2'/>").has("normalised"));
  CHECK(cloth("<float name='dyed' value='3'/>").has("scaled by"));
  CHECK(cloth("", "weave").has("a.wv:1"));
  CHECK(read_scene("0.6.0", "<bsdf type='irawan'/>").has("filename"));
}
