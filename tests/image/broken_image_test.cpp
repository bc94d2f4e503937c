#include <doctest/doctest.h>

#include <random>

#include "image/exr_io.h"
#include "image/image_io.h"
#include "support/images.h"

using namespace duet;
using namespace duet::test;

namespace {

/// What the error says after the path, or "" if the image can be read.
class Reader {
 public:
  explicit Reader(const std::string& name) : path_(directory_.path(name)) {}
  std::string operator()(std::string_view contents) const {
    directory_.write(path_.substr(path_.rfind('/') + 1), contents);
    try {
      read_image(path_);
    } catch (const ReadError& e) {
      const std::string what = e.what();
      REQUIRE(what.substr(0, path_.size() + 2) == path_ + ": ");
      return what.substr(path_.size() + 2);
    }
    return "";
  }

 private:
  TemporaryDirectory directory_;
  std::string path_;
};

/// How many of the files cut at every `step`-th byte are refused, of how many.
void check_cuts(const std::string& name, const std::string& file, size_t step,
                size_t spare_bytes = 0) {
  INFO(name);
  const Reader read(name);
  REQUIRE(read(file) == "");
  for (size_t length = 0; length + spare_bytes < file.size(); length += step) {
    INFO(length);
    CHECK(read(std::string_view(file).substr(0, length)) != "");
  }
}

/// Changes bytes at random: an error or an image, nothing else.
void check_changes(const std::string& name, const std::string& file, int count) {
  const Reader read(name);
  std::mt19937 generator(1);
  for (int i = 0; i < count; ++i) {
    std::string changed = file;
    for (int k = 0; k < 1 + i % 4; ++k) {
      // Headers matter most.
      const size_t range = i % 2 ? file.size() : std::min<size_t>(file.size(), 300);
      changed[generator() % range] = char(generator());
    }
    read(changed);
  }
}

std::string exr_file() {
  Image image(40, 50, {"R", "G", "B", "depth.Z"});
  std::mt19937 generator(1);
  for (float& v : image.data) v = float(generator() % 1000);
  const std::vector<uint8_t> bytes = encode_exr(image, {});
  return {bytes.begin(), bytes.end()};
}

std::string display_file(const char* name) {
  TemporaryDirectory directory;
  std::vector<uint8_t> bytes(40 * 50 * 3);
  std::mt19937 generator(1);
  for (uint8_t& b : bytes) b = uint8_t(generator() % 200);
  write_display_image(directory.path(name), 40, 50, 3, bytes);
  return read_file(directory.path(name));
}

std::string replace(std::string file, size_t position, const std::string& bytes) {
  return file.replace(position, bytes.size(), bytes);
}

}  // namespace

TEST_CASE("cut images are refused wherever they are cut") {
  check_cuts("a.exr", exr_file(), 41);
  check_cuts("a.png", display_file("a.png"), 37, 12);  // the end mark may be missing
  check_cuts("a.jpg", display_file("a.jpg"), 23);
  const std::string pixels(40 * 50 * 3, 'x');
  check_cuts("a.bmp", bmp(40, 50, pixels), 97);
  check_cuts("a.tga", tga(40, 50, 24, pixels), 97);
  check_cuts("a.tif", tiff(40, 50, pixels), 97);
  check_cuts("a.hdr", hdr(40, 50, std::string(40 * 50 * 4, '\x81')), 97);
  check_cuts("a.pfm", "Pf\n40 50\n-1.0\n" + std::string(40 * 50 * 4, 'x'), 97);
}

TEST_CASE("a JPEG file is complete at its end mark, whatever follows or stands in a thumbnail") {
  const Reader read("a.jpg");
  const std::string file = display_file("a.jpg");
  CHECK(read(file + "appended by a camera") == "");
  // A segment that holds an end mark of its own, as a thumbnail does.
  const std::string thumbnail("\xff\xe1\0\x08\xff\xd8\xff\xd9xx", 10);
  const std::string with_thumbnail = file.substr(0, 2) + thumbnail + file.substr(2);
  CHECK(read(with_thumbnail) == "");
  CHECK(read(with_thumbnail.substr(0, with_thumbnail.size() - 2)) ==
        "the file ends in the middle of the image");
}

TEST_CASE("changed images give an error or an image") {
  check_changes("a.exr", exr_file(), 1500);
  check_changes("a.png", display_file("a.png"), 300);
  check_changes("a.jpg", display_file("a.jpg"), 300);
  const std::string pixels(40 * 50 * 3, 'x');
  check_changes("a.bmp", bmp(40, 50, pixels), 300);
  check_changes("a.tga", tga(40, 50, 24, pixels), 300);
  check_changes("a.tif", tiff(40, 50, pixels), 300);
  check_changes("a.hdr", hdr(40, 50, std::string(40 * 50 * 4, '\x81')), 300);
}

TEST_CASE("sizes that a file cannot hold are refused before memory is taken") {
  const Reader exr("a.exr");
  const std::string file = exr_file();
  const size_t window = file.find("dataWindow") + 11 + 6 + 4;
  REQUIRE(exr(replace(file, window, pack(0, 0, 39, 49))) == "");
  for (const std::string& size :
       {pack(0, 0, 1 << 20, 49), pack(0, 0, 99999, 99999), pack(0, 0, 39, 2000000000),
        pack(-2000000000, 0, 2000000000, 49), pack(0, 0, -1, -1)})
    CHECK(exr(replace(file, window, size)) != "");

  // A thousand channels of one long line: the header alone would ask for half a gigabyte.
  std::vector<std::string> names;
  for (int i = 0; i < 1000; ++i) names.push_back(fmt::format("c{}", i));
  const std::vector<uint8_t> wide = encode_exr(Image(1, 1, names), {});
  const std::string wide_file(wide.begin(), wide.end());
  CHECK(exr(replace(wide_file, wide_file.find("dataWindow") + 21, pack(0, 0, 131071, 0))) ==
        "the file is too short for an image of 131072 x 1 with 1000 channels");

  const Reader other("a.img");
  for (const auto& [width, height] :
       {std::pair{100000u, 100000u}, {1u << 20, 1u}, {0x7fffffffu, 0x7fffffffu}, {0u, 5u}}) {
    CHECK(other(png(width, height, 8, 2, "x")) != "");
    CHECK(other(bmp(int32_t(width), int32_t(height), "xxxx")) != "");
    CHECK(other(tiff(width, height, "xxx")) != "");
    CHECK(other(hdr(int(width), int(height), "xxxx")) != "");
    CHECK(other(fmt::format("P6\n{} {}\n255\nxxx", width, height)) != "");
  }
  CHECK(Reader("a.tga")(tga(65535, 65535, 32, "xxxx")) ==
        "the file is too short for an image of 65535 x 65535");
}

TEST_CASE("what is no image is refused") {
  TemporaryDirectory directory;
  const Reader read("a.png");
  CHECK(read("") == "is empty");
  CHECK(read("<html>not found</html>").find("is not an image of a known kind") == 0);
  CHECK(read("GIF89a").find("is not an image of a known kind") == 0);
  CHECK(read("\x76\x2f\x31\x01") != "");
  CHECK(read("\x89PNG\r\n\x1a\n") != "");
  CHECK(read("\xff\xd8\xff") == "the file ends in the middle of the image");
  CHECK(Reader("a.tga")("short") != "");
  const std::string missing = directory.path("missing.exr");
  CHECK_THROWS_WITH_AS(read_image(missing),
                       (missing + ": cannot be opened: No such file or directory").c_str(),
                       ReadError);
  CHECK_THROWS_WITH_AS(read_image(directory.path(".")), doctest::Contains("is not a file"),
                       ReadError);
  CHECK_THROWS_WITH_AS(read_image("/dev/zero"), "/dev/zero: is not a file", ReadError);
}
