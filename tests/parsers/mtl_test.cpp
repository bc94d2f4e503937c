#include "mesh/mtl.h"

#include <doctest/doctest.h>

#include "base/diagnostics.h"

using namespace duet;

namespace {

std::string message(const std::string& text) {
  try {
    parse_mtl(text, "a.mtl");
  } catch (const ReadError& error) {
    return error.what();
  }
  return "";
}

using Numbers = std::array<double, 3>;

}  // namespace

TEST_CASE("MTL: what is read of a material, and where it stands") {
  const auto all = parse_mtl(
      "# made by hand\r\n\r\nnewmtl red paint \r\n\tKd 0.8 .1 1e-1 # sRGB\r\nKs 0.5\nNs +150\n"
      "Ka 1 1 1\nTr nothing\nillum 2\nnewmtl leaf\nmap_Kd leaf.png -s 1\nd 0.75\nbump bark.png",
      "a.mtl");
  REQUIRE(all.size() == 2);
  CHECK(all[0].name == "red paint");
  CHECK(all[0].line == 3);
  CHECK(all[0].diffuse.numbers == Numbers{0.8, 0.1, 0.1});
  CHECK(all[0].diffuse.line == 4);
  CHECK(all[0].specular.numbers == Numbers{0.5, 0.5, 0.5});
  CHECK(all[0].exponent.numbers[0] == 150);
  CHECK(all[0].illum == 2);
  CHECK(all[0].opacity.line == 0);
  CHECK(all[1].name == "leaf");
  CHECK(all[1].diffuse.image == "leaf.png");
  CHECK(all[1].opacity.numbers[0] == 0.75);
  CHECK(all[1].bump.image == "bark.png");
  CHECK(all[1].bump.line == 13);
  CHECK(all[1].illum == 0);
}

TEST_CASE("MTL: of several lines about one thing the last counts") {
  const auto a = parse_mtl("newmtl a\nKd 1 1 1\nmap_Kd a.png\nmap_Ks b.png\nKs 0 0 1\n", "");
  CHECK(a[0].diffuse.image == "a.png");
  CHECK(a[0].specular.image.empty());
  CHECK(a[0].specular.numbers == Numbers{0, 0, 1});
  CHECK(parse_mtl("newmtl a\nmap_d a.png\nd 1\n", "")[0].opacity.line == 0);
  CHECK(parse_mtl("newmtl a\nd 0.5\nmap_d a.png\n", "")[0].opacity.image == "a.png");
}

TEST_CASE("MTL: continued lines count, and files without materials are empty") {
  const auto a = parse_mtl("\xef\xbb\xbfnewmtl a\nKd 1\\\n0 \\\r\n0.5\nd 0.5\\", "");
  CHECK(a[0].diffuse.numbers == Numbers{1, 0, 0.5});
  CHECK(a[0].diffuse.line == 2);
  CHECK(a[0].opacity.line == 5);
  CHECK(parse_mtl("", "").empty());
  CHECK(parse_mtl("\\\n\\", "").empty());
  CHECK(parse_mtl("Ka 1 1 1\n", "").empty());
}

TEST_CASE("MTL: what is broken is said with its line") {
  CHECK(message("newmtl a\nKd red\n") == "a.mtl:2: \"red\" is not a number (Kd)");
  CHECK(message("newmtl a\n\nKd 1 1\n") == "a.mtl:3: Kd needs a number");
  CHECK(message("newmtl a\nKs\n") == "a.mtl:2: Ks needs a number");
  CHECK(message("newmtl a\nKd 1 1 nan\n") == "a.mtl:2: \"nan\" is not a number (Kd)");
  CHECK(message("newmtl a\nNs 1e400\n") == "a.mtl:2: \"1e400\" is not a number (Ns)");
  CHECK(message("newmtl a\nNs 1e39\n") == "a.mtl:2: \"1e39\" is not a number (Ns)");
  CHECK(message("newmtl a\nNs 1,5\n") == "a.mtl:2: \"1,5\" is not a number (Ns)");
  CHECK(message("newmtl a\nd 1.5\n") == "a.mtl:2: an opacity is from 0 to 1, not 1.5");
  CHECK(message("newmtl a\nd -1\n") == "a.mtl:2: an opacity is from 0 to 1, not -1");
  CHECK(message("newmtl a\nillum 2.5\n") == "a.mtl:2: 2.5 is not an illumination model");
  CHECK(message("newmtl a\nmap_Kd  \n") == "a.mtl:2: map_Kd needs the name of an image");
  CHECK(message("newmtl\n") == "a.mtl:1: newmtl needs a name");
  CHECK(message("Ka 1\nKd 1 1 1\n") == "a.mtl:2: no material has begun: newmtl is missing");
  CHECK(message(std::string("newmtl a\0b\n", 11)) == "a.mtl:1: not a text file");
  const std::string long_word(1000, 'x');
  CHECK(message("newmtl a\nKd " + long_word).size() < 100);
}
