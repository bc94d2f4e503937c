#include "base/numbering.h"

#include <doctest/doctest.h>

#include "math/hash.h"

using namespace duet;

TEST_CASE("things are numbered in order of appearance and found again, also when hashes collide") {
  for (const bool collide : {false, true}) {
    Numbering numbering;
    std::vector<int> things;
    const int count = collide ? 300 : 20000;
    for (int round = 0; round < 2; ++round)
      for (int i = 0; i < count; ++i) {
        const uint32_t n = numbering.number(collide ? 5 : mix64(uint64_t(i)),
                                            [&](uint32_t k) { return things[k] == i; });
        if (n == things.size()) things.push_back(i);
        REQUIRE(n == uint32_t(i));
      }
    CHECK(numbering.size() == uint32_t(count));
  }
}
