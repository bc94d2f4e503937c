#include "image/plain_jpeg.h"

#include <doctest/doctest.h>
// jpeglib.h needs these before it.
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <random>

#include "support/images.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

struct JpegKind {
  J_COLOR_SPACE from = JCS_RGB, stored = JCS_YCbCr;
  int sampling = 1;  ///< pixels for each number of chroma, either way
  bool progressive = false;
  unsigned restart = 0;  ///< blocks from marker to marker
  int quality = 90;
};

/// A file of noise over a gradient.
std::vector<uint8_t> jpeg(unsigned width, unsigned height, const JpegKind& kind) {
  jpeg_compress_struct c{};
  jpeg_error_mgr errors{};
  c.err = jpeg_std_error(&errors);
  jpeg_create_compress(&c);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&c, &out, &size);
  c.image_width = width;
  c.image_height = height;
  c.in_color_space = kind.from;
  c.input_components = kind.from == JCS_GRAYSCALE ? 1 : kind.from == JCS_CMYK ? 4 : 3;
  jpeg_set_defaults(&c);
  jpeg_set_colorspace(&c, kind.stored);
  jpeg_set_quality(&c, kind.quality, TRUE);
  if (kind.progressive) jpeg_simple_progression(&c);
  c.restart_interval = kind.restart;
  c.comp_info[0].h_samp_factor = c.comp_info[0].v_samp_factor = kind.sampling;
  jpeg_start_compress(&c, TRUE);
  std::mt19937 random(7);
  std::vector<uint8_t> row(size_t(width) * size_t(c.input_components));
  for (unsigned y = 0; y < height; ++y) {
    for (size_t i = 0; i < row.size(); ++i) row[i] = uint8_t((i + 5 * y + random() % 64) % 256);
    JSAMPROW rows[] = {row.data()};
    jpeg_write_scanlines(&c, rows, 1);
  }
  jpeg_finish_compress(&c);
  const std::vector<uint8_t> bytes(out, out + size);
  jpeg_destroy_compress(&c);
  std::free(out);
  return bytes;
}

bool jpeg_is_as_by_the_module(const std::vector<uint8_t>& file) {
  return is_read_as_by_the_module(read_plain_jpeg(file), "jpeg", file);
}

}  // namespace

TEST_CASE("JPEG files have the pixels that OpenImageIO reads") {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {17u, 33u}, {150u, 40u}})
    for (const bool progressive : {false, true}) {
      SHOW(width);
      CAPTURE(progressive);
      for (const int sampling : {1, 2})
        CHECK(jpeg_is_as_by_the_module(
            jpeg(width, height, {.sampling = sampling, .progressive = progressive})));
      CHECK(jpeg_is_as_by_the_module(
          jpeg(width, height,
               {.from = JCS_GRAYSCALE, .stored = JCS_GRAYSCALE, .progressive = progressive})));
      CHECK(jpeg_is_as_by_the_module(
          jpeg(width, height, {.stored = JCS_RGB, .progressive = progressive})));
      CHECK(jpeg_is_as_by_the_module(
          jpeg(width, height, {.progressive = progressive, .restart = 3, .quality = 20})));
    }
}

TEST_CASE("JPEG files for printers are left to OpenImageIO") {
  CHECK(!read_plain_jpeg(jpeg(9, 9, {.from = JCS_CMYK, .stored = JCS_CMYK})));
  CHECK(!read_plain_jpeg(jpeg(9, 9, {.from = JCS_CMYK, .stored = JCS_YCCK})));
}

TEST_CASE("damaged JPEG files are left to OpenImageIO, or read as it reads them") {
  const std::vector<uint8_t> file = jpeg(40, 40, {.restart = 2});
  REQUIRE(jpeg_is_as_by_the_module(file));
  for (size_t length = 0; length < file.size() - 2; length += 3)
    CHECK(!read_plain_jpeg({file.begin(), file.begin() + std::ptrdiff_t(length)}));
  for (size_t i = 2; i < file.size(); ++i) {
    std::vector<uint8_t> changed = file;
    changed[i] ^= 0x11;
    CAPTURE(i);
    if (read_plain_jpeg(changed)) CHECK(jpeg_is_as_by_the_module(changed));
  }
}
