// Every scene against its reference, which Mitsuba has rendered (docs/references.md).
#include <cstdlib>

#include "image/image_io.h"
#include "image/metrics.h"
#include "references/rendering.h"

using namespace duet;
using namespace duet::test;

namespace {

struct Case {
  std::string reference, scene;
  Defines defines;
  int spp;
  /// Twice what was measured when the case was written.
  double relative_rmse;
  double z_share = kRequiredZShare;
};

/// For scenes with paths so rare and bright that the spread of the reference's passes has missed
/// them in some pixels: there no number of samples makes the differences normal.
constexpr double kHeavyTails = 0.992;

const std::vector<Case> kCases{
    {"bsdf-conductors", "bsdf-conductors", {}, 256, 0.06},
    {"bsdf-dielectrics", "bsdf-dielectrics", {}, 256, 0.11},
    {"bsdf-plastics", "bsdf-plastics", {}, 256, 0.066},
    {"bsdf-principled", "bsdf-principled", {}, 1024, 0.08, kHeavyTails},
    {"bsdf-wrappers", "bsdf-wrappers", {}, 1024, 0.05, kHeavyTails},
    {"camera", "camera", {}, 256, 0.01},
    {"cornell-box", "cornell-box", {{"size", "128"}}, 512, 0.05},
    {"depth-of-field", "depth-of-field", {}, 256, 0.017},
    {"environment-map", "environment-map", {}, 256, 0.062},
    {"filters-tent", "filters", {{"filter", "tent"}}, 256, 0.016},
    {"filters-gaussian", "filters", {{"filter", "gaussian"}}, 256, 0.014},
    {"filters-mitchell", "filters", {{"filter", "mitchell"}}, 256, 0.017},
    {"filters-catmullrom", "filters", {{"filter", "catmullrom"}}, 256, 0.02},
    {"filters-lanczos", "filters", {{"filter", "lanczos"}}, 256, 0.022},
    {"hide-emitters", "hide-emitters", {}, 256, 0.022},
    {"instances", "instances", {}, 256, 0.07},
    {"lights-area", "lights-area", {}, 256, 0.07},
    {"lights-delta", "lights-delta", {}, 256, 0.19},
    {"media-heterogeneous", "media-heterogeneous", {}, 256, 0.043},
    {"media-homogeneous", "media-homogeneous", {}, 256, 0.37, 0.985},
    {"media-nested", "media-nested", {}, 256, 0.1, kHeavyTails},
    {"media-phase", "media-phase", {}, 256, 0.083},
    {"mesh-lumpy", "mesh-lumpy", {{"size", "128"}}, 256, 0.05},
    {"orthographic", "orthographic", {}, 256, 0.023},
    {"shapes", "shapes", {}, 256, 0.011},
    {"spectra", "spectra", {}, 256, 0.018},
    {"textures", "textures", {}, 256, 0.01},
    {"thesis-empty", "thesis-empty", {{"size", "128"}}, 1024, 0.035},
    {"thesis-modified", "thesis-modified", {{"size", "128"}}, 1024, 0.2},
    {"two-versions", "two-versions", {}, 256, 0.021},
};

double reference_spp(const ImageFile& file) {
  for (const auto& [name, value] : file.header)
    if (name == "spp") return std::atof(value.c_str());
  return 0;
}

}  // namespace

TEST_SUITE("references") {
  TEST_CASE("scenes agree with Mitsuba") {
    for (const Case& c : kCases) {
      CAPTURE(c.reference);
      const ImageFile mean = read_image(source_path("reference/" + c.reference + "/mean.exr"));
      const ImageFile variance =
          read_image(source_path("reference/" + c.reference + "/variance.exr"));
      REQUIRE(reference_spp(mean) > 0);
      const Image image = PreparedScene(c.scene, c.defines).render(c.spp);
      const ImageMetrics m = compare_images(
          image, mean.image, NoiseModel{&variance.image, double(c.spp), reference_spp(mean)});
      CHECK(m.nan_pixels + m.infinite_pixels == 0);
      CHECK(m.relative_rmse < c.relative_rmse);
      CHECK(std::abs(*m.bias) < kNotableBias);
      CHECK(*m.z_share > c.z_share);
      // Far more noise than one sample's variance explains would hide a bias.
      CHECK(*m.z_rms < 1.3);
    }
  }

  TEST_CASE("an image that is one percent too dark does not pass for Mitsuba's") {
    const std::string folder = source_path("reference/textures");
    const ImageFile mean = read_image(folder + "/mean.exr");
    const ImageFile variance = read_image(folder + "/variance.exr");
    Image image = PreparedScene("textures").render(256);
    for (float& v : image.data) v *= 0.99f;
    const ImageMetrics m =
        compare_images(image, mean.image, NoiseModel{&variance.image, 256, reference_spp(mean)});
    CHECK(std::abs(*m.bias) > kNotableBias);
  }
}
