// Images of textures: what is said of them when they are read.
#include <algorithm>
#include <cmath>

#include "image/image_io.h"
#include "support/files.h"
#include "support/textured_scene.h"

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

long count(const TexturedScene& scene, const std::string& text) {
  const auto& all = scene.read.diagnostics.all();
  return std::count_if(all.begin(), all.end(), [&](const Diagnostic& d) {
    return d.message.find(text) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("numbers of images that are not finite are replaced, and said once") {
  const TemporaryDirectory folder;
  Image image(1, 1, {"R", "G", "B"});
  image.data = {NAN, 0.25f, INFINITY};
  const std::string file = folder.path("odd.exr");
  write_exr(file, image, {});
  const TexturedScene scene("3.0.0", square(bitmap(file)) + square(bitmap(file)));
  CHECK(scene.albedo(0, 0) == Spectrum(0, 0.25f, 65504));
  CHECK(count(scene, "odd.exr: has numbers that are not finite (2)") == 1);
}

TEST_CASE("an image that cannot be read is an error only where a shape has it") {
  const TemporaryDirectory folder;
  const std::string file = folder.write("cut.png", "\x89PNG\r\n\x1a\n");
  const TexturedScene unused("3.0.0", bitmap(file) + square(""));
  CHECK(unused.scene);
  CHECK(count(unused, "cut.png") == 0);
  const TexturedScene used("3.0.0", square(bitmap(file)) + square(bitmap(file)));
  CHECK(!used.scene);
  CHECK(count(used, "cut.png: ") == 1);
}
