#include "image/cryptomatte.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace duet;

TEST_CASE("the hash of names is MurmurHash3") {
  // From the author's own program and other implementations.
  CHECK(murmur3_32("") == 0);
  CHECK(murmur3_32("test") == 0xba6bd213u);
  CHECK(murmur3_32("hello") == 0x248bfa47u);
  CHECK(murmur3_32("hello, world") == 0x149bbb7fu);
  CHECK(murmur3_32("Hello, world!") == 0xc0363e43u);
  CHECK(murmur3_32("The quick brown fox jumps over the lazy dog") == 0x2e4ff723u);
}

TEST_CASE("ids of mattes are normal floats, and hashes otherwise") {
  std::set<uint32_t> exponents;
  for (int i = 0; i < 4000; ++i) {
    const std::string name = "thing " + std::to_string(i);
    const uint32_t hash = murmur3_32(name), id = matte_id(name), exponent = hash >> 23 & 255;
    CHECK(std::fpclassify(matte_value(id)) == FP_NORMAL);
    CHECK(id == (exponent == 0 || exponent == 255 ? hash ^ 0x00800000u : hash));
    exponents.insert(exponent);
  }
  // Both were among them.
  CHECK(exponents.contains(0));
  CHECK(exponents.contains(255));
}

TEST_CASE("channels of mattes have the names that readers look for") {
  const std::vector<std::string> names = matte_channels(MatteKind::object);
  REQUIRE(names.size() == 2 * kMatteRanks);
  CHECK(names[0] == "CryptoObject00.R");
  CHECK(names[3] == "CryptoObject00.A");
  CHECK(names[11] == "CryptoObject02.A");
  CHECK(matte_channels(MatteKind::material)[4] == "CryptoMaterial01.R");
  CHECK(is_matte_channel("CryptoMaterial02.B"));
  CHECK(!is_matte_channel("CryptoMaterial03.B"));
  CHECK(!is_matte_channel("CryptoObject.R"));
}
