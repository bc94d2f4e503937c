#include <doctest/doctest.h>

#include "support/volume_files.h"
#include "volume/vol_file.h"

using namespace duet;
using namespace duet::test;

namespace {

VolumeFile volume_of(const std::string& text) {
  ByteReader in("test.vol", bytes_of(text));
  return parse_vol(in);
}

std::string volume_failure(const std::string& text) {
  try {
    volume_of(text);
  } catch (const ReadError& e) {
    return e.what();
  }
  return "";
}

VolumeText file(int encoding, const std::string& values, int channels = 1) {
  VolumeText f;
  f.encoding = encoding;
  f.channels = channels;
  f.values = values;
  return f;
}

}  // namespace

TEST_CASE("vol: all encodings") {
  const VolumeFile floats = volume_of(file(1, pack(0.25f, -3.0f)).text());
  CHECK(floats.grid.values == std::vector<float>{0.25f, -3});
  CHECK(floats.grid.size == std::array<int, 3>{2, 1, 1});
  CHECK(floats.grid.lower == std::array<float, 3>{-1, 0, 0});
  CHECK(floats.grid.upper == std::array<float, 3>{1, 2, 4});
  CHECK(floats.is_float32);
  // 1, the smallest denormal, −2.5, the greatest number.
  const VolumeFile halves = volume_of(file(2,
                                           pack(uint16_t(0x3c00), uint16_t(1), uint16_t(0xc100),
                                                uint16_t(0x7bff), uint16_t(0), uint16_t(0x8000)),
                                           3)
                                          .text());
  CHECK(halves.grid.values == std::vector<float>{1, 0x1p-24f, -2.5f, 65504, 0, 0});
  CHECK(!halves.is_float32);
  const VolumeFile bytes = volume_of(file(3, pack(uint8_t(255), uint8_t(51))).text());
  CHECK(bytes.grid.values == std::vector<float>{1, 0.2f});
  const VolumeFile directions =
      volume_of(file(4, pack(uint8_t(0), uint8_t(7), uint8_t(255), uint8_t(0)), 3).text());
  const std::vector<float>& v = directions.grid.values;
  REQUIRE(v.size() == 6);
  CHECK(v[2] == 1);
  CHECK(v[5] == -1);
  const VolumeFile side =
      volume_of(file(4, pack(uint8_t(85), uint8_t(85), uint8_t(0), uint8_t(0)), 3).text());
  CHECK(side.grid.values[0] == doctest::Approx(std::sin(M_PI / 3) * std::cos(2 * M_PI / 3)));
  CHECK(side.grid.values[1] == doctest::Approx(std::sin(M_PI / 3) * std::sin(2 * M_PI / 3)));
  CHECK(side.grid.values[2] == doctest::Approx(0.5));
}

TEST_CASE("vol: x runs fastest, channels are neighbours, further bytes are left alone") {
  VolumeText f = file(3, "", 3);
  f.x = 1, f.y = 2, f.z = 2;
  for (int i = 0; i < 12; ++i) f.values += char(i);
  f.values += "more";
  const VolumeGrid grid = volume_of(f.text()).grid;
  REQUIRE(grid.values.size() == 12);
  CHECK(grid.node_count() == 4);
  CHECK(grid.values[7] == 7 / 255.0f);
}

TEST_CASE("vol: broken files are refused with the reason") {
  const auto has = [](const std::string& text, const std::string& reason) {
    const std::string message = volume_failure(text);
    CHECK_MESSAGE(message.find(reason) != std::string::npos, message);
    CHECK(message.starts_with("test.vol: "));
  };
  has("", "is not a volume file");
  has("VO", "is not a volume file");
  has("PLY\x03", "is not a volume file");
  has("VOL", "is not a volume file");
  has("VOL\x03", "in the middle of the header");
  VolumeText f = file(1, pack(1.0f, 2.0f));
  const std::string good = f.text();
  CHECK(volume_failure(good) == "");
  has(good.substr(0, 40), "in the middle of the header");
  has(good.substr(0, good.size() - 1), "in the middle of its values");
  f.version = 2;
  has(f.text(), "is of version 2");
  f = file(5, pack(1.0f, 2.0f));
  has(f.text(), "unknown encoding 5");
  f = file(1, pack(1.0f, 2.0f));
  f.x = -2;
  has(f.text(), "impossible size of -2 x 1 x 1");
  f.x = f.y = f.z = 65536;
  has(f.text(), "in the middle of its values");
  f.x = 65537;
  has(f.text(), "impossible size");
  f = file(1, pack(1.0f, 2.0f, 3.0f, 4.0f), 2);
  has(f.text(), "2 channels");
  f = file(4, pack(1.0f), 1);
  has(f.text(), "directions with 1 channels");
  f = file(1, pack(1.0f, NAN));
  has(f.text(), "value 1 is not finite");
  f = file(2, pack(uint16_t(0x7c00), uint16_t(0)));
  has(f.text(), "value 0 is not finite");
  f = file(1, pack(1.0f, 2.0f));
  f.box = {0, 0, 0, 1, 0, 1};
  has(f.text(), "fills no box");
  f.box = {0, 0, 0, 1, INFINITY, 1};
  has(f.text(), "fills no box");
}

TEST_CASE("vol: files that are none") {
  CHECK_THROWS_AS(read_vol("/nowhere/at/all.vol"), ReadError);
  CHECK_THROWS_AS(read_vol("/"), ReadError);
}
