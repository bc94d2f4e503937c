#include "image/image_io.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "support/images.h"
#include "support/texts.h"

using namespace duet;
using namespace duet::test;

namespace {

using Names = std::vector<std::string>;

std::vector<uint8_t> as_bytes(const std::string& s) {
  return {s.begin(), s.end()};
}

}  // namespace

TEST_CASE("PNG: bytes come back as they were, alpha included") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.png");
  std::mt19937 generator(1);
  const Names names[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  for (int channels = 1; channels <= 4; ++channels) {
    std::vector<uint8_t> bytes(size_t(13 * 7 * channels));
    for (uint8_t& b : bytes) b = uint8_t(generator());
    write_display_image(path, 13, 7, channels, bytes);
    const ImageFile file = read_image(path);
    CHECK(file.image.channels == names[channels - 1]);
    CHECK(file.image.width == 13);
    CHECK(file.image.height == 7);
    CHECK(file.image.data.empty());
    CHECK(file.bytes == bytes);
    CHECK(file.display_encoded);
    CHECK(file.display_size == Point2i{13, 7});
    const std::string first = read_file(path);
    write_display_image(path, 13, 7, channels, bytes);
    CHECK(read_file(path) == first);
  }
  CHECK(directory.count() == 1);
}

TEST_CASE("PNG: values of 16 bits come back as they were, alpha included") {
  TemporaryDirectory directory;
  std::mt19937 generator(2);
  for (int channels = 1; channels <= 4; ++channels) {
    std::vector<uint16_t> values(size_t(13 * 7 * channels));
    for (uint16_t& v : values) v = uint16_t(generator());
    const auto bytes = display_image_bytes("a.png", 13, 7, channels, values, {{"spp", "7"}});
    const std::string path = directory.write("a.png", std::string(bytes.begin(), bytes.end()));
    const ImageFile file = read_image(path);
    CHECK(file.display_encoded);
    CHECK(file.image.channel_count() == channels);
    REQUIRE(file.image.data.size() == values.size());
    for (size_t i = 0; i < values.size(); ++i)
      CHECK(std::lround(65535 * double(file.image.data[i])) == values[i]);
  }
  CHECK_THROWS_WITH_AS(display_image_bytes("a.jpg", 1, 1, 1, std::vector<uint16_t>{7}),
                       "a.jpg cannot be written: JPEG has 8 bits", std::runtime_error);
}

TEST_CASE("PNG: files say that they are encoded with sRGB's curve, and rows may be long") {
  constexpr int kWidth = 1500000;  // libpng reads and writes at most a million unless it is told
  const auto bytes = display_image_bytes("a.png", kWidth, 1, 1, std::vector<uint8_t>(kWidth, 7));
  const std::string file(bytes.begin(), bytes.end());
  CHECK(contains(file, "sRGB"));
  CHECK(contains(file, "gAMA" + pack_swapped(45455u)));
  CHECK(contains(file, pack_swapped(uint32_t(kWidth), 1u)));
}

TEST_CASE("JPEG: smooth images come back nearly as they were, also in their colours") {
  TemporaryDirectory directory;
  for (const char* name : {"a.jpg", "b.JPEG"}) {
    const std::string path = directory.path(name);
    for (const int channels : {1, 3}) {
      std::vector<uint8_t> bytes;
      for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 50; ++x)
          for (int c = 0; c < channels; ++c)
            bytes.push_back(uint8_t(c == 0 ? 5 * x : c == 1 ? 6 * y : 255 - 2 * (x + y)));
      write_display_image(path, 50, 40, channels, bytes);
      const ImageFile file = read_image(path);
      CHECK(file.image.channel_count() == channels);
      CHECK(file.display_encoded);
      REQUIRE(file.bytes.size() == bytes.size());
      int worst = 0;
      for (size_t i = 0; i < bytes.size(); ++i)
        worst = std::max(worst, std::abs(int(file.bytes[i]) - int(bytes[i])));
      CHECK(worst <= 4);
    }
  }
  // Colours that alternate between columns survive only if chroma is not halved.
  std::vector<uint8_t> stripes;
  for (int i = 0; i < 16 * 16; ++i)
    for (int c = 0; c < 3; ++c) stripes.push_back((i % 2 == 0) == (c == 0) ? 200 : 50);
  write_display_image(directory.path("a.jpg"), 16, 16, 3, stripes);
  const ImageFile file = read_image(directory.path("a.jpg"));
  for (size_t i = 0; i < stripes.size(); ++i)
    REQUIRE(std::abs(int(file.bytes[i]) - int(stripes[i])) < 40);
}

TEST_CASE("display images that cannot be written are errors") {
  TemporaryDirectory directory;
  const std::vector<uint8_t> bytes(16);
  CHECK_THROWS_WITH_AS(write_display_image(directory.path("no/a.png"), 2, 2, 4, bytes),
                       doctest::Contains("No such file or directory"), std::runtime_error);
  CHECK_THROWS_WITH_AS(write_display_image(directory.path("a.jpg"), 2, 2, 4, bytes),
                       doctest::Contains("JPEG has no alpha"), std::runtime_error);
  CHECK_THROWS_WITH_AS(write_display_image(directory.path("a.gif"), 2, 2, 4, bytes),
                       doctest::Contains("only .png and .jpg"), std::runtime_error);
  CHECK_THROWS_AS(write_display_image(directory.path("a.png"), 2, 3, 4, bytes),
                  std::invalid_argument);
  CHECK_THROWS_AS(write_display_image(directory.path("a.png"), 0, 0, 4, {}), std::invalid_argument);
  CHECK(directory.count() == 0);
}

TEST_CASE("PNG: 16 bits become floats") {
  TemporaryDirectory directory;
  const std::string rows = std::string(1, '\0') + pack_swapped(uint16_t(0), uint16_t(65535)) +
                           std::string(1, '\0') + pack_swapped(uint16_t(32768), uint16_t(1));
  const ImageFile file = read_image(directory.write("a.png", png(2, 2, 16, 0, rows)));
  CHECK(file.image.channels == Names{"Y"});
  CHECK(file.bytes.empty());
  CHECK(file.display_encoded);
  CHECK(file.image.data[0] == 0);
  CHECK(file.image.data[1] == 1);
  CHECK(file.image.data[2] == doctest::Approx(32768 / 65535.0));
  CHECK(file.image.data[3] == doctest::Approx(1 / 65535.0));
}

TEST_CASE("PNG: alpha is not multiplied in") {
  TemporaryDirectory directory;
  const std::string row("\0\x64\xc8\x32\x80\xff\xff\xff\0", 9);
  const ImageFile file = read_image(directory.write("a.png", png(2, 1, 8, 6, row)));
  CHECK(file.bytes == std::vector<uint8_t>{0x64, 0xc8, 0x32, 0x80, 255, 255, 255, 0});
}

TEST_CASE("BMP, TGA, TIFF and PNM: from the top, red first, told apart by their contents") {
  TemporaryDirectory directory;
  // Red, green / blue, white.
  const std::vector<uint8_t> expected{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  const std::string top("\xff\0\0\0\xff\0", 6), bottom("\0\0\xff\xff\xff\xff", 6);
  const std::string top_bgr("\0\0\xff\0\xff\0", 6), bottom_bgr("\xff\0\0\xff\xff\xff", 6);
  const std::string pad(2, '\0');
  const std::string files[] = {
      directory.write("a.bmp", bmp(2, 2, bottom_bgr + pad + top_bgr + pad)),
      directory.write("a.tga", tga(2, 2, 24, top_bgr + bottom_bgr)),
      directory.write("a.tiff", tiff(2, 2, top + bottom)),
      directory.write("a.ppm", "P6\n2 2\n255\n" + top + bottom),
      directory.write("lies.png", "P3\n2 2\n255\n255 0 0 0 255 0 0 0 255 255 255 255\n"),
      directory.write("lies.exr", bmp(2, 2, bottom_bgr + pad + top_bgr + pad)),
      directory.write("noextension", tiff(2, 2, top + bottom))};
  for (const std::string& path : files) {
    INFO(path);
    const ImageFile file = read_image(path);
    CHECK(file.image.channels == Names{"R", "G", "B"});
    CHECK(file.bytes == expected);
    CHECK(file.display_encoded);
  }
  const ImageFile alpha =
      read_image(directory.write("alpha.tga", tga(1, 1, 32, std::string("\x0a\x14\x1e\x80"))));
  CHECK(alpha.bytes == std::vector<uint8_t>{0x1e, 0x14, 0x0a, 0x80});
}

TEST_CASE("HDR and PFM are linear floats") {
  TemporaryDirectory directory;
  const ImageFile rgbe = read_image(
      directory.write("a.hdr", hdr(2, 1, std::string("\x80\x40\x20\x81\x80\x80\x80\x85", 8))));
  CHECK_FALSE(rgbe.display_encoded);
  CHECK(rgbe.bytes.empty());
  CHECK(rgbe.image.data == std::vector<float>{1, 0.5f, 0.25f, 16, 16, 16});
  // The rows of PFM stand from the bottom.
  const ImageFile grey =
      read_image(directory.write("a.pfm", "Pf\n1 2\n-1.0\n" + pack(-2.5f, 1e6f)));
  CHECK(grey.image.channels == Names{"Y"});
  CHECK_FALSE(grey.display_encoded);
  CHECK(grey.image.data == std::vector<float>{1e6f, -2.5f});
  const ImageFile swapped =
      read_image(directory.write("b.pfm", "PF\n1 1\n1.0\n" + pack_swapped(1.0f, 2.0f, 3.0f)));
  CHECK(swapped.image.data == std::vector<float>{1, 2, 3});
}

// Runs in a process of its own, with DUET_IMAGE_MODULE set to a name that does not exist.
TEST_CASE(
    "without the module, EXR, JPEG and plain PNG files work, other formats say what is missing" *
    doctest::skip()) {
  TemporaryDirectory directory;
  const std::string module = std::getenv("DUET_IMAGE_MODULE");
  Image image(2, 2, {"R", "G", "B"});
  write_exr(directory.path("a.exr"), image, {});
  CHECK(read_image(directory.path("a.exr")).image.data == image.data);
  const std::string row("\0\x64\xc8\x32", 4);
  CHECK(read_image(directory.write("read.png", png(1, 1, 8, 2, row))).bytes ==
        std::vector<uint8_t>{0x64, 0xc8, 0x32});
  const std::string path = directory.write("a.bmp", bmp(1, 1, std::string("abc\0", 4)));
  CHECK_THROWS_WITH_AS(read_image(path),
                       (path +
                        ": this image format needs the library duet_oiio.so, which was not "
                        "found (set DUET_IMAGE_MODULE to its path); tried\n  " +
                        module)
                           .c_str(),
                       ReadError);
  write_display_image(directory.path("a.png"), 1, 1, 3, as_bytes("abc"));
  CHECK(read_image(directory.path("a.png")).bytes == as_bytes("abc"));
  write_display_image(directory.path("a.jpg"), 1, 1, 1, as_bytes("a"));
  CHECK(read_image(directory.path("a.jpg")).bytes == as_bytes("a"));
  // Nothing has loaded OpenImageIO.
  CHECK(read_file("/proc/self/maps").find("OpenImageIO") == std::string::npos);
}
