// The bytes that tev is sent.
#include "evaluate/live/tev_message.h"

#include <doctest/doctest.h>

#include "support/files.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string text_of(const std::vector<uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

Image two_by_three() {
  Image image(2, 3, {"R", "depth.T"});
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i) + 0.5f;
  return image;
}

const std::string kZero(1, '\0');

}  // namespace

TEST_CASE("tev is told to create an image by its name, size and channels") {
  const std::string fields = kZero + "a.exr" + kZero + pack(int32_t(2), int32_t(3), int32_t(2)) +
                             "R" + kZero + "depth.T" + kZero;
  const std::string message = text_of(tev_create_image("a.exr", two_by_three()));
  CHECK(message == pack(uint32_t(4 + 1 + fields.size()), uint8_t(4)) + fields);
}

TEST_CASE("tev gets the values of one channel, rows from the top") {
  const std::string head = kZero + "a.exr" + kZero + "depth.T" + kZero +
                           pack(int32_t(0), int32_t(0), int32_t(2), int32_t(3));
  const std::string values = pack(1.5f, 3.5f, 5.5f, 7.5f, 9.5f, 11.5f);
  const std::string message = text_of(tev_update_channel("a.exr", two_by_three(), 1));
  CHECK(message == pack(uint32_t(4 + 1 + head.size() + values.size()), uint8_t(3)) + head + values);
}

TEST_CASE("a name with a zero in it does not shift the fields behind it") {
  const std::string name = "a" + kZero + "b";
  CHECK(tev_create_image(name, two_by_three()) == tev_create_image("a", two_by_three()));
}
