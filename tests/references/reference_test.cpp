// Every scene against its reference, which Mitsuba has rendered (docs/references.md).
#include "image/bias_test.h"
#include "image/metrics.h"
#include "references/cases.h"

using namespace duet;
using namespace duet::test;

TEST_SUITE("references") {
  TEST_CASE("scenes agree with Mitsuba") {
    for (const ReferenceCase& c : reference_cases()) {
      CAPTURE(c.reference);
      const Reference reference(c.reference);
      const Image image = PreparedScene(c.scene, c.defines).render(c.spp);
      const NoiseModel noise{&reference.variance, double(c.spp), reference.spp};
      const ImageMetrics m = compare_images(image, reference.mean, noise);
      CHECK(test_bias(image, reference.mean, noise).biased() == c.differs);
      CHECK(m.nan_pixels + m.infinite_pixels == 0);
      CHECK(m.relative_rmse < c.relative_rmse);
      CHECK(std::abs(*m.bias) < kNotableBias);
      CHECK(*m.z_share > c.z_share);
      // Far more noise than one sample's variance explains would hide a bias.
      CHECK(*m.z_rms < 1.3);
    }
  }

  TEST_CASE("an image that is one percent too dark does not pass for Mitsuba's") {
    const Reference reference("textures");
    Image image = PreparedScene("textures").render(256);
    for (float& v : image.data) v *= 0.99f;
    const NoiseModel noise{&reference.variance, 256, reference.spp};
    CHECK(std::abs(*compare_images(image, reference.mean, noise).bias) > kNotableBias);
    CHECK(test_bias(image, reference.mean, noise).biased());
  }
}
