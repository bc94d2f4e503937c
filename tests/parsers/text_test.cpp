#include "values/text.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("numbers are read with white space around them and nothing else") {
  CHECK(parse_number(" 1.5 ") == 1.5);
  CHECK(parse_number("+1.5") == 1.5);
  CHECK(parse_number("-4.37114e-008") == -4.37114e-008);
  CHECK(parse_number(".5") == 0.5);
  CHECK(parse_number("1.") == 1.0);
  CHECK(parse_number("1e-400") == 0.0);
  for (const char* bad : {"", " ", "1.5f", "1,5", "--1", "+-1", "0x10", "one", "inf", "-inf", "nan",
                          "1e50", "1e400", "1 2", "e5", "1e"}) {
    CAPTURE(bad);
    CHECK(!parse_number(bad));
  }
}

TEST_CASE("integers and truth values") {
  CHECK(parse_integer(" 42\n") == 42);
  CHECK(parse_integer("-1") == -1);
  CHECK(parse_integer("4294967295") == 4294967295);
  for (const char* bad : {"", "1.0", "1e3", "99999999999999999999", "0x1", "a"}) {
    CAPTURE(bad);
    CHECK(!parse_integer(bad));
  }
  CHECK(parse_boolean("true") == true);
  CHECK(parse_boolean("False") == false);
  CHECK(!parse_boolean("1"));
  CHECK(!parse_boolean(""));
}

TEST_CASE("lists may be separated by commas, spaces or both") {
  CHECK(parse_numbers("1,2 3 ,\n4,") == std::vector<double>{1, 2, 3, 4});
  CHECK(parse_numbers("")->empty());
  CHECK(!parse_numbers("1;2"));
  CHECK(split_list(" a:1, b ").size() == 2);
}

TEST_CASE("camelCase and snake_case are the same name") {
  const std::pair<const char*, const char*> names[] = {
      {"toWorld", "to_world"},
      {"intIOR", "int_ior"},
      {"fovAxis", "fov_axis"},
      {"cropOffsetX", "crop_offset_x"},
      {"maxDepth", "max_depth"},
      {"rrDepth", "rr_depth"},
      {"alphaU", "alpha_u"},
      {"diffuseReflectance", "diffuse_reflectance"},
      {"B", "B"},
      {"p0", "p0"},
      {"already_snake", "already_snake"},
  };
  for (const auto& [camel, snake] : names) CHECK(snake_case(camel) == snake);
  CHECK(camel_case("to_world") == "toWorld");
  CHECK(camel_case("p0") == "p0");
}

TEST_CASE("text in messages is short and on one line") {
  CHECK(in_quotes("a\nb") == "\"a b\"");
  CHECK(in_quotes(std::string(1000, 'x')).size() < 100);
}
