// Images of textures: what is said of them when they are read.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "image/image_io.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/memory_scene.h"
#include "textures/texture.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string bitmap(const std::string& file) {
  return "<bsdf type='diffuse'><texture name='reflectance' type='bitmap'><string name='filename' "
         "value='" +
         file + "'/></texture></bsdf>";
}

std::string square(const std::string& bsdf) {
  return "<shape type='rectangle'>" + bsdf + "</shape>";
}

struct FileScene {
  Diagnostics diagnostics;
  std::unique_ptr<Scene> scene;

  FileScene(const TemporaryDirectory& folder, const std::string& content) {
    auto read =
        read_mitsuba(folder.write("scene.xml", scene_text("3.0.0", content)), {}, diagnostics);
    REQUIRE(read);
    scene = build_scene(std::move(read->description), {}, diagnostics);
  }
  long count(const std::string& text) const {
    const auto& all = diagnostics.all();
    return std::count_if(all.begin(), all.end(), [&](const Diagnostic& d) {
      return d.message.find(text) != std::string::npos;
    });
  }
};

}  // namespace

TEST_CASE("numbers of images that are not finite are replaced, and said once") {
  const TemporaryDirectory folder;
  Image image(1, 1, {"R", "G", "B"});
  image.data = {NAN, 0.25f, INFINITY};
  write_exr(folder.path("odd.exr"), image, {});
  const FileScene file(folder, square(bitmap("odd.exr")) + square(bitmap("odd.exr")));
  REQUIRE(file.scene);
  CHECK(file.scene->textures[0]->average() == Spectrum(0, 0.25f, 65504));
  CHECK(file.count("odd.exr: has numbers that are not finite (2)") == 1);
}

TEST_CASE("an image that cannot be read is an error only where a shape has it") {
  const TemporaryDirectory folder;
  folder.write("cut.png", "\x89PNG\r\n\x1a\n");
  const FileScene unused(folder, bitmap("cut.png") + square(""));
  CHECK(unused.scene);
  CHECK(unused.count("cut.png") == 0);
  const FileScene used(folder, square(bitmap("cut.png")) + square(bitmap("cut.png")));
  CHECK(!used.scene);
  CHECK(used.count("cut.png: ") == 1);
}
