// --png-depth, --aov-names and --exr-parts: in which form duet render and duet merge write images.
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <doctest/doctest.h>

#include <cmath>

#include "app/workplace.h"
#include "image/image_io.h"
#include "math/spectrum.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

using Texts = std::vector<std::string>;

/// The values of a PNG file of 16 bits.
std::vector<long> words(const std::string& path) {
  std::vector<long> values;
  for (const float v : read_image(path).image.data) values.push_back(std::lround(65535 * v));
  return values;
}

Texts part_names(const std::string& path) {
  Imf::MultiPartInputFile file(path.c_str());
  Texts names;
  for (int p = 0; p < file.parts(); ++p)
    names.push_back(file.header(p).hasName() ? file.header(p).name() : "");
  return names;
}

/// That both have the same channels, wherever they stand, with the same values.
void check_same_channels(const Image& a, const Image& b) {
  REQUIRE(a.channels.size() == b.channels.size());
  for (size_t c = 0; c < a.channels.size(); ++c) {
    CAPTURE(a.channels[c]);
    const int other = b.find_channel(a.channels[c]);
    REQUIRE(other >= 0);
    for (size_t i = c, j = size_t(other); i < a.data.size();
         i += a.channels.size(), j += b.channels.size())
      REQUIRE(a.data[i] == b.data[j]);
  }
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("PNG files of 16 bits have values between those of 8") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    const Texts files{"tiny.xml", "-o", "a.exr", "-o", "a.png", "-o", "a.jpg"};
    REQUIRE(place.run(files).code == 0);
    const ImageFile bytes = read_image(place.path("a.png"));
    Texts deep = files;
    deep.insert(deep.end(), {"--png-depth", "16"});
    const Outcome o = place.run(deep);
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const Image linear = read_image(place.path("a.exr")).image;
    const ImageFile shown = read_image(place.path("a.png"));
    const std::vector<long> values = words(place.path("a.png"));
    REQUIRE(values.size() == bytes.bytes.size());
    CHECK(read_image(place.path("a.jpg")).bytes.size() == values.size());
    int between = 0;
    const size_t channels = linear.channels.size(), shown_channels = shown.image.channels.size();
    for (size_t i = 0; i < values.size(); ++i) {
      const float v = linear.data[i / shown_channels * channels + i % shown_channels];
      const float wanted = i % shown_channels < 3 ? linear_to_srgb(std::min(v, 1.0f)) : v;
      CHECK(std::abs(double(values[i]) - 65535.0 * double(wanted)) <= 1);
      CHECK(std::abs(double(values[i]) / 257 - bytes.bytes[i]) <= 0.51);
      between += values[i] % 257 != 0;
    }
    CHECK(between > 100);
    // The curves have as many values.
    deep.insert(deep.end(), {"--tonemap", "agx"});
    REQUIRE(place.run(deep).code == 0);
    const std::vector<long> curved = words(place.path("a.png"));
    CHECK(curved != values);
    CHECK(std::count_if(curved.begin(), curved.end(), [](long v) { return v % 257 != 0; }) > 100);
    CHECK(place.run({"tiny.xml", "--png-depth", "12"}).code == 2);
  }

  TEST_CASE("a form of files that are not written is a warning") {
    const Workplace place;
    place.scene("tiny.xml");
    struct Form {
      Texts options;
      Texts without, with;  ///< files that have no such form, and files that have it
    };
    const Form forms[] = {{{"--png-depth", "16"}, {"a.jpg", "a.exr"}, {"a.png"}},
                          {{"--tonemap", "agx"}, {"a.exr"}, {"a.jpg", "a.png"}},
                          {{"--exposure", "1"}, {"a.exr"}, {"a.jpg", "a.png"}},
                          {{"--exposure", "auto"}, {"a.exr"}, {"a.jpg", "a.png"}},
                          {{"--aov-names", "nuke"}, {"a.jpg", "a.png"}, {"a.exr"}},
                          {{"--exr-parts"}, {"a.jpg", "a.png"}, {"a.exr"}}};
    const auto run = [&](const Form& form, const std::string& file, Texts more = {}) {
      Texts arguments{"tiny.xml", "--spp", "1", "-q", "-o", file};
      arguments.insert(arguments.end(), form.options.begin(), form.options.end());
      arguments.insert(arguments.end(), more.begin(), more.end());
      return place.run(arguments);
    };
    for (const Form& form : forms) {
      CAPTURE(form.options[0]);
      const std::string text = form.options[0] + ": there is no ";
      for (const std::string& file : form.without) {
        CHECK(contains(run(form, file).err, text));
        CHECK(run(form, file, {"--strict"}).code == 1);
        for (const std::string& other : form.with)
          CHECK(run(form, file, {"-o", other}).err.empty());
      }
      for (const std::string& file : form.with) CHECK(run(form, file).err.empty());
    }
    REQUIRE(place.run({"tiny.xml", "--spp", "1", "--raw", "raw.exr", "-q"}).code == 0);
    const Outcome merged = place.run({"merge", "raw.exr", "-o", "a.exr", "-q", "--tonemap", "agx"});
    CHECK(merged.code == 0);
    CHECK(contains(merged.err, "--tonemap: there is no .png or .jpg to be written"));
  }

  TEST_CASE("alpha of 16 bits is not multiplied into colours") {
    const Workplace place;
    place.write("lamp.xml", R"(<scene version="3.0.0">
      <integrator type="path"/>
      <sensor type="perspective"><float name="fov" value="60"/>
        <transform name="to_world"><lookat origin="0,0,2" target="0,0,0" up="0,1,0"/></transform>
        <sampler type="independent"><integer name="sample_count" value="37"/></sampler>
        <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="24"/>
          <string name="pixel_format" value="rgba"/><rfilter type="box"/></film></sensor>
      <shape type="disk"><emitter type="area"><rgb name="radiance" value="0.5"/></emitter></shape>
      </scene>)");
    REQUIRE(place.run({"lamp.xml", "-o", "lamp.png", "--png-depth", "16"}).code == 0);
    const std::vector<long> values = words(place.path("lamp.png"));
    REQUIRE(values.size() == 24 * 24 * 4);
    const auto half = double(linear_to_srgb(0.5f));
    int in_part = 0;
    for (size_t i = 0; i < values.size(); i += 4) {
      if (values[i + 3] == 0) continue;
      CHECK(std::abs(double(values[i]) - 65535 * half) <= 1);
      // A number of samples of 37.
      const double covered = 37 * double(values[i + 3]) / 65535;
      CHECK(std::abs(covered - std::round(covered)) < 1e-3);
      in_part += values[i + 3] < 65535 && values[i + 3] % 257 != 0;
    }
    CHECK(in_part >= 12);
  }

  TEST_CASE("layers get the names of a program, and duet compare finds the colours") {
    const Workplace place;
    TinyScene s = exact_scene();
    place.scene("tiny.xml", s);
    const Texts render{"tiny.xml", "--aov", "normal,depth,shape", "-o", "a.exr"};
    REQUIRE(place.run(render).code == 0);
    const Image plain = read_image(place.path("a.exr")).image;
    const std::pair<const char*, Texts> programs[] = {
        {"blender",
         {"ViewLayer.Combined.G", "ViewLayer.Normal.Z", "ViewLayer.Depth.Z",
          "ViewLayer.IndexOB.X"}},
        {"nuke", {"G", "N.blue", "depth.Z", "shape.red"}},
        {"mitsuba", {"G", "sh_normal.Z", "depth.T", "shape_index.I"}}};
    for (const auto& [program, names] : programs) {
      SHOW(program);
      Texts all = render;
      all.back() = "b.exr";
      all.insert(all.end(), {"--aov-names", program});
      const Outcome o = place.run(all);
      CAPTURE(o.err);
      REQUIRE(o.code == 0);
      const Image named = read_image(place.path("b.exr")).image;
      REQUIRE(named.channels.size() == plain.channels.size());
      const char* const own[] = {"G", "normal.Z", "depth.T", "shape.I"};
      for (size_t k = 0; k < 4; ++k) {
        const int a = plain.find_channel(own[k]), b = named.find_channel(names[k]);
        SHOW(names[k]);
        REQUIRE(b >= 0);
        for (int y = 0; y < plain.height; ++y)
          for (int x = 0; x < plain.width; ++x) CHECK(named.pixel(x, y)[b] == plain.pixel(x, y)[a]);
      }
      const Outcome same = place.run({"compare", "b.exr", "a.exr", "--require", "rmse<1e-9"});
      CAPTURE(same.err);
      CHECK(same.code == 0);
    }
    const Outcome clash =
        place.run({"tiny.xml", "--aov", "normal,sh_normal", "-o", "c.exr", "--aov-names", "nuke"});
    CHECK(clash.code == 2);
    CHECK(contains(clash.err,
                   "--aov-names: with the names of nuke, normal.X and sh_normal.X are "
                   "both called N.red"));
    CHECK(!place.has("c.exr"));
    CHECK(place.run({"tiny.xml", "--aov-names", "houdini"}).code == 2);
  }

  TEST_CASE("layers become parts of their own, also of images that are merged") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    const Texts layers{"--aov", "normal,depth"}, form{"--exr-parts", "--aov-names", "blender"};
    const auto run = [&](Texts arguments, const Texts& more, const Texts& others = {}) {
      arguments.insert(arguments.end(), more.begin(), more.end());
      arguments.insert(arguments.end(), others.begin(), others.end());
      const Outcome o = place.run(arguments);
      CAPTURE(o.err);
      REQUIRE(o.code == 0);
    };
    run({"tiny.xml", "-o", "plain.exr"}, layers);
    run({"tiny.xml", "-o", "parts.exr", "--exr-parts"}, layers);
    CHECK(part_names(place.path("plain.exr")).size() == 1);
    CHECK(part_names(place.path("parts.exr")) == Texts{"rgb", "normal", "depth"});
    const Image plain = read_image(place.path("plain.exr")).image;
    check_same_channels(read_image(place.path("parts.exr")).image, plain);
    CHECK(place.run({"compare", "parts.exr", "plain.exr", "--require", "rmse<1e-9"}).code == 0);

    run({"tiny.xml", "-o", "both.exr"}, layers, form);
    CHECK(part_names(place.path("both.exr")) ==
          Texts{"ViewLayer.Combined", "ViewLayer.Normal", "ViewLayer.Depth"});
    CHECK(place.run({"compare", "both.exr", "plain.exr", "--require", "rmse<1e-9"}).code == 0);
    for (const char* k : {"1", "2"})
      run({"tiny.xml", "--slice", std::string(k) + "/2", "--raw", std::string(k) + ".exr"}, layers);
    run({"merge", "1.exr", "2.exr", "-o", "merged.exr", "-o", "merged.png", "--png-depth", "16"},
        form);
    check_same_channels(read_image(place.path("merged.exr")).image,
                        read_image(place.path("both.exr")).image);
    CHECK(part_names(place.path("merged.exr")).size() == 3);
    CHECK(!read_image(place.path("merged.png")).image.data.empty());
  }
}
