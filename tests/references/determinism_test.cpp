// The same seed gives the same image, whoever computes which part of it.
#include "references/rendering.h"

using namespace duet;
using namespace duet::test;

namespace {

const char* const kTracedScenes[] = {"bsdf-wrappers", "depth-of-field", "environment-map",
                                     "filters",       "instances",      "textures"};

}  // namespace

TEST_CASE("scenes look the same with 1, 2 and 7 threads") {
  for (const char* name : kTracedScenes) {
    CAPTURE(name);
    const PreparedScene scene(name);
    const Image one = scene.render(8, 1);
    CHECK(scene.render(8, 2).data == one.data);
    CHECK(scene.render(8, 7).data == one.data);
  }
}

TEST_CASE("a crop of a scene has the very pixels of the whole image") {
  for (const char* name : kTracedScenes) {
    CAPTURE(name);
    const PreparedScene scene(name);
    const PixelBounds crop{13, 20, 50, 41};
    const Image whole = scene.render(8), part = scene.render(8, 2, crop);
    REQUIRE(part.width == crop.width());
    const size_t n = whole.channels.size();
    size_t different = 0;
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x)
        for (size_t c = 0; c < n; ++c)
          different +=
              part.data[(size_t(y) * size_t(part.width) + size_t(x)) * n + c] !=
              whole.data[(size_t(y + crop.y0) * size_t(whole.width) + size_t(x + crop.x0)) * n + c];
    CHECK(different == 0);
  }
}
