#include "evaluate/web/layers.h"

#include <doctest/doctest.h>

#include "evaluate/web/pixels.h"
#include "image/half.h"

using namespace duet;

namespace {

/// Base64 of one pixel.
std::string pixel(float r, float g, float b) {
  std::vector<uint8_t> bytes;
  for (const float v : {r, g, b}) {
    const uint16_t bits = half_bits(v);
    bytes.insert(bytes.end(), {uint8_t(bits), uint8_t(bits >> 8)});
  }
  return base64(bytes);
}

}  // namespace

TEST_CASE("the channels of an image become the layers of a viewer") {
  Image image(1, 1,
              {"A", "B", "G", "R", "albedo.R", "albedo.G", "albedo.B", "depth.T", "nn.X", "nn.Y",
               "nn.Z", "P.x", "P.y", "P.z", "odd.R", "odd.G", "N.red", "N.green", "N.blue"});
  for (size_t c = 0; c < image.channels.size(); ++c) image.data[c] = float(c);
  const std::vector<ViewedImage> layers = viewed_layers(image, 16);
  const std::pair<const char*, std::string> expected[] = {
      {"A", pixel(0, 0, 0)},        {"colours", pixel(3, 2, 1)},  {"albedo", pixel(4, 5, 6)},
      {"depth.T", pixel(7, 7, 7)},  {"nn", pixel(8, 9, 10)},      {"P", pixel(11, 12, 13)},
      {"odd.R", pixel(14, 14, 14)}, {"odd.G", pixel(15, 15, 15)}, {"N", pixel(16, 17, 18)}};
  REQUIRE(layers.size() == std::size(expected));
  for (size_t i = 0; i < layers.size(); ++i) {
    CHECK(layers[i].name == expected[i].first);
    CHECK(layers[i].image.half == expected[i].second);
    CHECK(layers[i].note == "");
  }
}

TEST_CASE("a grey image is one layer, and large ones are reduced") {
  Image image(4, 2, {"Y"});
  image.data = {0, 2, 4, 4, 2, 4, 4, 4};
  const std::vector<ViewedImage> layers = viewed_layers(image, 2);
  REQUIRE(layers.size() == 1);
  CHECK(layers[0].name == "Y");
  CHECK(layers[0].image.width == 2);
  CHECK(layers[0].image.height == 1);
  CHECK(layers[0].note == "means of 2 × 2 pixels");
}
