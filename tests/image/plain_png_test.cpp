#include "image/plain_png.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <random>

#include "support/images.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

std::vector<uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

/// A chunk by its type and data.
std::string chunk(const std::string& body) {
  const auto crc =
      uint32_t(crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size())));
  return pack_swapped(uint32_t(body.size() - 4)) + body + pack_swapped(crc);
}

/// Where the header ends: the mark of eight bytes, and a chunk of 13.
constexpr size_t kAfterHeader = 8 + 12 + 13;

std::string with_chunk(std::string file, const std::string& body) {
  return file.insert(kAfterHeader, chunk(body));
}

/// With everything behind the header replaced.
std::string with_body(const std::string& file, const std::string& chunks) {
  return file.substr(0, kAfterHeader) + chunks;
}

struct PngKind {
  int colour;
  size_t channels;
};
constexpr PngKind kPngKinds[] = {{0, 1}, {2, 3}, {4, 2}, {6, 4}};

/// Rows of random bytes, which have the filters in turn.
std::string random_rows(size_t width, size_t height, size_t channels, std::mt19937& random) {
  std::string rows;
  for (size_t y = 0; y < height; ++y) {
    rows += char(random() % 5);
    for (size_t i = 0; i < width * channels; ++i) rows += char(random());
  }
  return rows;
}

bool is_as_by_the_module(const std::string& file) {
  return is_read_as_by_the_module(read_plain_png(bytes_of(file)), "png", bytes_of(file));
}

bool is_left_to_the_module(const std::string& file) {
  return !read_plain_png(bytes_of(file));
}

}  // namespace

TEST_CASE("plain PNG files have the pixels that OpenImageIO reads") {
  std::mt19937 random(1);
  for (const PngKind& kind : kPngKinds)
    for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 23u}, {150u, 40u}}) {
      CAPTURE(kind.colour);
      SHOW(width);
      CHECK(is_as_by_the_module(
          png(width, height, 8, kind.colour, random_rows(width, height, kind.channels, random))));
    }
}

TEST_CASE("what else is in a plain PNG file changes no pixel") {
  std::mt19937 random(2);
  const std::string rows = random_rows(9, 8, 3, random), file = png(9, 8, 8, 2, rows);
  CHECK(is_as_by_the_module(with_chunk(file, "gAMA" + pack_swapped(45455u))));
  CHECK(is_as_by_the_module(with_chunk(file, "gAMA" + pack_swapped(100000u))));
  CHECK(is_as_by_the_module(with_chunk(file, std::string("sRGB\0", 5))));
  CHECK(is_as_by_the_module(with_chunk(file, "sBIT\5\6\5")));
  CHECK(is_as_by_the_module(with_chunk(file, std::string("tEXtTitle\0a", 11))));
  CHECK(is_as_by_the_module(with_chunk(file, "PLTEabcdef")));
  CHECK(is_as_by_the_module(with_chunk(file, std::string("bKGD\0\1\0\2\0\3", 10))));
  CHECK(is_as_by_the_module(file + "what follows"));
  // The stream in many pieces, empty ones among them.
  const std::string stream = deflate(rows);
  std::string pieces;
  for (size_t i = 0; i < stream.size(); i += 7)
    pieces += chunk("IDAT" + stream.substr(i, 7)) + chunk("IDAT");
  CHECK(is_as_by_the_module(with_body(file, pieces + chunk("IEND"))));
  // More than the pixels need.
  for (const std::string& more : {chunk("IDAT" + deflate(rows + "x")), chunk("IDAT" + stream + "x"),
                                  chunk("IDAT" + stream) + chunk("IDATx")})
    CHECK(is_as_by_the_module(with_body(file, more + chunk("IEND"))));
}

TEST_CASE("PNG files of rarer kinds are left to OpenImageIO") {
  std::mt19937 random(3);
  const std::string rows = random_rows(4, 4, 3, random), file = png(4, 4, 8, 2, rows);
  CHECK(is_left_to_the_module(png(4, 4, 16, 2, random_rows(4, 4, 6, random))));
  CHECK(is_left_to_the_module(png(8, 4, 1, 0, random_rows(1, 4, 1, random))));
  CHECK(
      is_left_to_the_module(with_chunk(png(4, 4, 8, 3, random_rows(4, 4, 1, random)), "PLTEabc")));
  CHECK(is_left_to_the_module(with_chunk(file, std::string("tRNS\0\1\0\2\0\3", 10))));
  std::string interlaced = file;
  const std::string header = "IHDR" + pack_swapped(4u, 4u) + std::string("\x8\x2\0\0\1", 5);
  interlaced.replace(8, 12 + 13, chunk(header));
  CHECK(is_left_to_the_module(interlaced));
}

TEST_CASE("damaged PNG files are left to OpenImageIO") {
  std::mt19937 random(4);
  const std::string rows = random_rows(6, 5, 4, random), file = png(6, 5, 8, 6, rows);
  REQUIRE(is_as_by_the_module(file));
  for (size_t length = 0; length < file.size(); ++length)
    CHECK(is_left_to_the_module(file.substr(0, length)));
  // Every byte is covered by a checksum; the mark has been looked at before.
  for (size_t i = 8; i < file.size(); ++i) {
    std::string changed = file;
    changed[i] = char(changed[i] ^ 0x10);
    CHECK(is_left_to_the_module(changed));
  }
  const std::string end = chunk("IEND"), stream = deflate(rows);
  const auto body = [&](const std::string& chunks) { return with_body(file, chunks + end); };
  CHECK(is_left_to_the_module(body(chunk("IDAT" + deflate(rows.substr(1))))));
  CHECK(is_left_to_the_module(body(chunk("IDAT" + stream.substr(0, stream.size() - 1)))));
  CHECK(is_left_to_the_module(body("")));
  CHECK(is_left_to_the_module(body(chunk("ABCD") + chunk("IDAT" + stream))));
  CHECK(is_left_to_the_module(body(chunk("IDAT" + stream.substr(0, 9)) + chunk("tIME1234567") +
                                   chunk("IDAT" + stream.substr(9)))));
  std::string filter = rows;
  filter[0] = 5;
  CHECK(is_left_to_the_module(png(6, 5, 8, 6, filter)));
  for (const auto& [width, height] :
       {std::pair{0u, 5u}, {6u, 0u}, {1u << 18, 1u}, {100000u, 100000u}})
    CHECK(is_left_to_the_module(png(width, height, 8, 6, rows)));
}
