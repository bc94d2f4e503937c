#include "base/file_names.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("extensions are in lower case and of the file alone") {
  CHECK(extension_of("folder.d/image.EXR") == ".exr");
  CHECK(extension_of("a.b.Png") == ".png");
  CHECK(extension_of("folder.d/image").empty());
  CHECK(extension_of(".hidden").empty());
}

TEST_CASE("names that begin with a dash are no options as operands") {
  CHECK(as_operand("-a/b.xml") == "./-a/b.xml");
  CHECK(as_operand("a/-b.xml") == "a/-b.xml");
  CHECK(as_operand("-") == "./-");
}
