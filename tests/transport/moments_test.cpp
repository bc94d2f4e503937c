// The layers of second moments where light sub-paths add to all pixels.
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("the variance layer predicts how far images of methods with splats spread") {
  const TransportScene scene(camera_xml("0, -3, 1", "0, 0, 1", 16) + room_xml(grey("0.7")) +
                             lamp_xml("0.4", "8"));
  for (const std::string name : {"path", "bdpt", "ptracer", "vcm"}) {
    CAPTURE(name);
    IntegratorDescription d = scene.integrator;
    apply_override(d, {name, {{"max_depth", "3"}, {"rr_depth", "100"}}, {"variance"}});
    RenderRequest request;
    request.budget.spp = 16;
    request.threads = 2;
    request.sequence = SampleSequence::independent;
    constexpr int kImages = 64;
    std::vector<double> sum, squares;
    double predicted = 0;
    for (int i = 0; i < kImages; ++i) {
      request.seed = uint64_t(i);
      const auto made = make_integrator(d);
      const Image image = render(*scene.scene, *made, scene.layout, request).image;
      const size_t n = image.channels.size(), pixels = image.data.size() / n;
      REQUIRE(image.channels[4] == "variance.R");
      sum.resize(pixels), squares.resize(pixels);
      for (size_t p = 0; p < pixels; ++p) {
        const double red = double(image.data[p * n]);
        sum[p] += red, squares[p] += red * red;
        predicted += double(image.data[p * n + 4]) / kImages;
      }
    }
    double found = 0;
    for (size_t p = 0; p < sum.size(); ++p)
      found += (squares[p] - sum[p] * sum[p] / kImages) / (kImages - 1);
    // Of n samples, the spread around their own mean is too small by a share of 1 / n.
    CHECK(predicted * 16 / 15 == doctest::Approx(found).epsilon(0.1));
  }
}
