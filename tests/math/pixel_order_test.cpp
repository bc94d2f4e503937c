// That the pixels of an image are divided evenly.
#include "math/pixel_order.h"

#include <doctest/doctest.h>

#include <set>

using namespace duet;

TEST_CASE("phases have every pixel once, and know how many they have") {
  for (const Point2i film : {Point2i{64, 48}, Point2i{1, 1}, Point2i{33, 7}, Point2i{50, 37}})
    for (const uint32_t count : {1u, 2u, 4u, 16u}) {
      CAPTURE(film.x);
      CAPTURE(count);
      PixelPhases divided;
      divided.start(film, 5);
      const auto pixels = size_t(film.x) * size_t(film.y);
      std::vector<int> phases(pixels);
      for (uint32_t k = 0; k < count; ++k) {
        const PixelPhase phase{&divided, k, count};
        std::set<uint64_t> ranks;
        for (uint64_t pixel = 0; pixel < pixels; ++pixel) {
          if (!phase.has(pixel)) continue;
          ++phases[pixel];
          CHECK(phase.rank(pixel) < phase.pixels());
          CHECK(ranks.insert(phase.rank(pixel)).second);
        }
        CHECK(ranks.size() == phase.pixels());
      }
      CHECK(phases == std::vector<int>(pixels, 1));
    }
}

TEST_CASE("sixteen phases are spread evenly over the image") {
  constexpr int kSize = 64;
  PixelPhases divided;
  divided.start({kSize, kSize}, 9);
  for (uint32_t k = 0; k < 16; ++k) {
    const PixelPhase phase{&divided, k, 16};
    // One pixel of every square of 4 × 4, which lie where the shift of their tile puts them: an
    // 8 × 8 square holds at least one of them whole, and has a part in nine at the most.
    for (int y0 = 0; y0 < kSize; y0 += 8)
      for (int x0 = 0; x0 < kSize; x0 += 8) {
        int count = 0;
        for (int i = 0; i < 64; ++i)
          count += phase.has(uint64_t((y0 + i / 8) * kSize + x0 + i % 8));
        CHECK(count >= 1);
        CHECK(count <= 9);
      }
  }
}
