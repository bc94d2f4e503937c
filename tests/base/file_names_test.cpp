#include "base/file_names.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("extensions are in lower case and of the file alone") {
  CHECK(extension_of("folder.d/image.EXR") == ".exr");
  CHECK(extension_of("a.b.Png") == ".png");
  CHECK(extension_of("folder.d/image").empty());
  CHECK(extension_of(".hidden").empty());
}
