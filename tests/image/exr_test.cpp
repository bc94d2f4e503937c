#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "image/image_facts.h"
#include "image/image_io.h"
#include "support/files.h"
#include "support/image_header.h"

using namespace duet;
using namespace duet::test;

namespace {

Image random_image(int width, int height, const std::vector<std::string>& channels) {
  Image image(width, height, channels);
  std::mt19937 generator(1);
  for (float& v : image.data) v = std::ldexp(float(generator()), int(generator() % 20) - 40);
  return image;
}

std::string field(const ImageFile& file, const std::string& name) {
  return header_field(file, name, "(none)");
}

/// Writes by OpenEXR itself a channel of the given type, with samples i at pixel i.
void write_channel(const std::string& path, Imf::Header header, Imf::PixelType type,
                   const void* samples, size_t size, int sampling = 1) {
  header.channels().insert("Z", Imf::Channel(type, sampling, sampling));
  Imf::OutputFile out(path.c_str(), header);
  Imf::FrameBuffer buffer;
  const Imath::Box2i window = header.dataWindow();
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  buffer.insert("Z", Imf::Slice::Make(type, samples, window.min, width, height, size,
                                      size * size_t(width / sampling), sampling, sampling));
  out.setFrameBuffer(buffer);
  out.writePixels(height);
}

}  // namespace

TEST_CASE("EXR: reading changes no limits of other users of OpenEXR in the process") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  write_exr(path, Image(4, 4, {"R", "G", "B"}), {});
  read_image(path);
  Imf::Header wide(1 << 20, 1);
  wide.channels().insert("Y", Imf::Channel(Imf::HALF));
  CHECK_NOTHROW(wide.sanityCheck());
  wide.setTileDescription(Imf::TileDescription(1 << 20, 1 << 15));
  CHECK_NOTHROW(wide.sanityCheck(true));
}

TEST_CASE("EXR: tiles larger than is read are refused from the header") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  Imf::Header header(8, 8);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(1 << 14, 16));
  { Imf::TiledOutputFile out(path.c_str(), header); }
  CHECK_THROWS_WITH_AS(read_image(path), (path + ": tiles of 16384 x 16 cannot be read").c_str(),
                       ReadError);
  CHECK_THROWS_AS(read_image_facts(path), ReadError);
}

TEST_CASE("EXR: indices are exact beside colours in half floats") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  Image image(40, 33, {"R", "G", "B", "A", "shape.I", "depth.T"});
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = float(i % 6 == 4 ? 2049 + 50 * i : 1);
  image.data[0] = 1 + 0x1p-12f;  // no half float
  image.data[5] = 100000.125f;
  ExrOptions options;
  options.full_precision = {"shape.I", "depth.T", "absent.X"};
  write_exr(path, image, options);
  const ImageFile file = read_image(path);
  REQUIRE(file.image.channels.size() == 6);
  const int shape = file.image.find_channel("shape.I"), depth = file.image.find_channel("depth.T");
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 40; ++x) CHECK(file.image.pixel(x, y)[shape] == image.pixel(x, y)[4]);
  CHECK(file.image.pixel(0, 0)[depth] == 100000.125f);
  CHECK(file.image.pixel(0, 0)[file.image.find_channel("R")] == 1);
}

TEST_CASE("EXR: single floats come back as they were, with layers in order") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  const Image image = random_image(19, 35,
                                   {"R", "G", "B", "A", "albedo.R", "albedo.G", "albedo.B",
                                    "depth.Z", "normal.X", "normal.Y", "normal.Z"});
  ExrOptions options;
  options.half = false;
  write_exr(path, image, options);
  const ImageFile file = read_image(path);
  CHECK(file.image.width == 19);
  CHECK(file.image.height == 35);
  CHECK(file.image.channels == image.channels);
  CHECK(file.image.data == image.data);
  CHECK(file.bytes.empty());
  CHECK_FALSE(file.display_encoded);
  CHECK(file.origin == Point2i{0, 0});
  CHECK(file.display_size == Point2i{19, 35});
  CHECK(field(file, "pixelAspectRatio") == "1");
}

TEST_CASE("EXR: each layer can be a part of its own") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  const Image image =
      random_image(19, 35, {"R", "G", "B", "A", "dd.y.T", "normal.X", "normal.Y", "normal.Z"});
  ExrOptions options;
  options.full_precision = {"dd.y.T"};
  options.origin = {3, 2};
  options.full_size = {40, 50};
  options.header = {{"spp", 7}};
  write_exr(directory.path("single.exr"), image, options);
  options.parts = true;
  write_exr(path, image, options);
  {
    Imf::MultiPartInputFile file(path.c_str());
    const std::pair<const char*, std::vector<std::string>> parts[] = {
        {"rgba", {"A", "B", "G", "R"}},
        {"dd.y", {"dd.y.T"}},
        {"normal", {"normal.X", "normal.Y", "normal.Z"}}};
    REQUIRE(file.parts() == 3);
    for (int p = 0; p < 3; ++p) {
      const Imf::Header& header = file.header(p);
      CHECK(header.name() == parts[p].first);
      CHECK(header.dataWindow().min == Imath::V2i(3, 2));
      CHECK((header.findTypedAttribute<Imf::IntAttribute>("spp") != nullptr) == (p == 0));
      std::vector<std::string> channels;
      for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        channels.emplace_back(c.name());
        CHECK(c.channel().type == (p == 1 ? Imf::FLOAT : Imf::HALF));
      }
      CHECK(channels == parts[p].second);
    }
    // The last pixel of the last part.
    Imf::FrameBuffer buffer;
    Imf::InputPart part(file, 2);
    std::vector<float> line(19);
    buffer.insert("normal.Z", Imf::Slice::Make(Imf::FLOAT, line.data(), {3, 2 + 34}, 19, 1));
    part.setFrameBuffer(buffer);
    part.readPixels(2 + 34);
    const float wanted = image.pixel(18, 34)[7];
    CHECK(line[18] == doctest::Approx(wanted).epsilon(1e-3));
  }
  const ImageFile single = read_image(directory.path("single.exr")), parts = read_image(path);
  REQUIRE(parts.image.channels.size() == single.image.channels.size());
  for (size_t c = 0; c < parts.image.channels.size(); ++c) {
    const int other = single.image.find_channel(parts.image.channels[c]);
    REQUIRE(other >= 0);
    for (size_t i = 0; i < 19 * 35; ++i)
      CHECK(parts.image.data[8 * i + c] == single.image.data[8 * i + size_t(other)]);
  }
  CHECK(field(parts, "spp") == "7");
  CHECK(parts.origin == Point2i{3, 2});
  write_exr(directory.path("again.exr"), image, options);
  CHECK(read_file(directory.path("again.exr")) == read_file(path));
}

TEST_CASE("EXR: halves are rounded to nearest and do not overflow") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  Image image(4, 2, {"Y"});
  image.data = {0.1f, -1e6f, 1e6f, 65503, INFINITY, -INFINITY, NAN, 1e-9f};
  write_exr(path, image, {});
  const std::vector<float> read = read_image(path).image.data;
  CHECK(std::abs(read[0] - 0.1f) < 3e-5f);
  CHECK(read[1] == -65504);
  CHECK(read[2] == 65504);
  CHECK(read[3] == 65504);
  CHECK(read[4] == INFINITY);
  CHECK(read[5] == -INFINITY);
  CHECK(std::isnan(read[6]));
  CHECK(read[7] == 0);
}

TEST_CASE("EXR: crop windows and header fields") {
  TemporaryDirectory directory;
  const std::string path = directory.path("crop.exr");
  const Image image = random_image(7, 40, {"R", "G", "B"});
  ExrOptions options;
  options.half = false;
  options.origin = {30, 20};
  options.full_size = {100, 80};
  options.pixel_aspect = 0.5f;
  std::array<float, 16> matrix;
  for (size_t i = 0; i < 16; ++i) matrix[i] = float(i) / 2;
  options.header = {{"program", "Duet"},
                    {"seconds", 1.5f},
                    {"spp", 64},
                    {"empty", ""},
                    {"worldToCamera", matrix}};
  write_exr(path, image, options);
  const ImageFile file = read_image(path);
  CHECK(file.image.data == image.data);
  CHECK(file.origin == Point2i{30, 20});
  CHECK(file.display_size == Point2i{100, 80});
  CHECK(field(file, "program") == "Duet");
  CHECK(field(file, "seconds") == "1.5");
  CHECK(field(file, "spp") == "64");
  CHECK(field(file, "empty") == "");
  CHECK(field(file, "worldToCamera") == "0 0.5 1 1.5 2 2.5 3 3.5 4 4.5 5 5.5 6 6.5 7 7.5");
  CHECK(field(file, "pixelAspectRatio") == "0.5");
}

TEST_CASE("EXR: equal images give equal bytes, and old files are replaced") {
  TemporaryDirectory directory;
  const Image image = random_image(33, 33, {"R", "G", "B"});
  write_exr(directory.path("a.exr"), image, {});
  directory.write("b.exr", "something else");
  write_exr(directory.path("b.exr"), image, {});
  CHECK(read_file(directory.path("a.exr")) == read_file(directory.path("b.exr")));
  CHECK(directory.count() == 2);
}

TEST_CASE("EXR: what cannot be written is an error and leaves no file") {
  TemporaryDirectory directory;
  const Image image = random_image(4, 4, {"R", "G", "B"});
  CHECK_THROWS_WITH_AS(write_exr(directory.path("no/a.exr"), image, {}),
                       doctest::Contains("No such file or directory"), std::runtime_error);
  CHECK_THROWS_AS(write_exr(directory.path("a.exr"), Image(), {}), std::runtime_error);
  CHECK_THROWS_AS(write_exr(directory.path("a.exr"), Image(2, 2, {"R", "R"}), {}),
                  std::runtime_error);
  ExrOptions clash;
  clash.header = {{"compression", "none"}};  // the format's own field, of another type
  CHECK_THROWS_AS(write_exr(directory.path("a.exr"), image, clash), std::runtime_error);
  CHECK(directory.count() == 0);
}

TEST_CASE("EXR: integers, tiles, windows beyond the display") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  const std::vector<uint32_t> integers{0, 1, 2, 3000000000u};
  write_channel(path, Imf::Header({{0, 0}, {9, 9}}, Imath::Box2i({-3, 5}, {0, 5})), Imf::UINT,
                integers.data(), sizeof(uint32_t));
  const ImageFile file = read_image(path);
  CHECK(file.image.channels == std::vector<std::string>{"Z"});
  CHECK(file.image.data == std::vector<float>{0, 1, 2, 3000000000.0f});
  CHECK(file.origin == Point2i{-3, 5});
  CHECK(file.display_size == Point2i{10, 10});

  const Image image = random_image(37, 21, {"B"});
  Imf::Header header(37, 21);
  header.channels().insert("B", Imf::Channel(Imf::FLOAT));
  header.setTileDescription({16, 8, Imf::MIPMAP_LEVELS});
  header.compression() = Imf::PIZ_COMPRESSION;
  {
    Imf::TiledOutputFile out(path.c_str(), header);
    Imf::FrameBuffer buffer;
    buffer.insert(
        "B", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(image.data.data())),
                        sizeof(float), sizeof(float) * 37));
    out.setFrameBuffer(buffer);
    for (int level = 0; level < out.numLevels(); ++level)
      out.writeTiles(0, out.numXTiles(level) - 1, 0, out.numYTiles(level) - 1, level);
  }
  CHECK(read_image(path).image.data == image.data);
}

TEST_CASE("EXR: the parts of a file become layers") {
  TemporaryDirectory directory;
  const std::string path = directory.path("parts.exr");
  const auto write = [&](int second_width) {
    const Imath::Box2i display({0, 0}, {2, 1}), second({0, 0}, {second_width - 1, 1});
    std::vector<Imf::Header> headers{Imf::Header(display, display), Imf::Header(display, second)};
    const char* const names[2] = {"main", "left"};
    for (size_t i = 0; i < 2; ++i) {
      headers[i].setName(names[i]);
      headers[i].setType(Imf::SCANLINEIMAGE);
      headers[i].channels().insert("G", Imf::Channel(Imf::FLOAT));
      headers[i].channels().insert("R", Imf::Channel(Imf::FLOAT));
    }
    Imf::MultiPartOutputFile out(path.c_str(), headers.data(), 2);
    for (int i = 0; i < 2; ++i) {
      std::vector<float> r(8, float(10 * i + 1)), g(8, float(10 * i + 2));
      Imf::FrameBuffer buffer;
      buffer.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(r.data()), 4, 0));
      buffer.insert("G", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(g.data()), 4, 0));
      Imf::OutputPart part(out, i);
      part.setFrameBuffer(buffer);
      part.writePixels(2);
    }
  };
  write(3);
  const ImageFile file = read_image(path);
  CHECK(file.image.channels == std::vector<std::string>{"R", "G", "left.R", "left.G"});
  CHECK(std::vector<float>(file.image.pixel(2, 1), file.image.pixel(2, 1) + 4) ==
        std::vector<float>{1, 2, 11, 12});
  write(4);
  CHECK_THROWS_WITH_AS(read_image(path),
                       (path + ": parts of different size cannot be read").c_str(), ReadError);
}

TEST_CASE("EXR: deep and subsampled images are refused") {
  TemporaryDirectory directory;
  const std::string path = directory.path("a.exr");
  const std::vector<float> samples(16);
  write_channel(path, Imf::Header(8, 8), Imf::FLOAT, samples.data(), sizeof(float), 2);
  CHECK_THROWS_WITH_AS(read_image(path), (path + ": channel Z is subsampled").c_str(), ReadError);

  Imf::Header header(2, 2);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  {
    Imf::DeepScanLineOutputFile out(path.c_str(), header);
    std::vector<unsigned> counts(4, 1);
    float value = 1;
    std::vector<float*> pointers(4, &value);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 8));
    buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), 8, 16,
                                      sizeof(float)));
    out.setFrameBuffer(buffer);
    out.writePixels(2);
  }
  CHECK_THROWS_WITH_AS(read_image(path), (path + ": deep images cannot be read").c_str(),
                       ReadError);
}
