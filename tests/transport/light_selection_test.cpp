// By whatever lights are chosen, images have the same mean.
#include <doctest/doctest.h>

#include "math/statistics.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string number(double v) {
  return std::to_string(v);
}

/// A room with bulbs, points, a mesh of many triangles, a spot, and a sky through the open side.
std::string content(const std::string& selection) {
  std::string text = "<integrator type='path'><string name='light_selection' value='" + selection +
                     "'/></integrator>" + camera_xml("0, -3, 1", "0, 0, 1", 16) +
                     room_xml(grey("0.7, 0.5, 0.3")) +
                     "<emitter type='constant'><rgb name='radiance' value='0.05'/></emitter>"
                     "<emitter type='spot'><transform name='to_world'><lookat origin='0.6,0,1.8' "
                     "target='0,0.3,0' up='0,1,0'/></transform></emitter>";
  const std::string area = "<emitter type='area'><rgb name='radiance' value='6'/></emitter>";
  for (int i = 0; i < 12; ++i) {
    const std::string x = number(-0.9 + 0.16 * i);
    text += sphere_xml(x + ", 0.6, " + number(0.2 + 0.13 * i), "0.04", area);
    text += "<emitter type='point'><point name='position' value='" + x +
            ", -0.4, 1.7'/><rgb name='intensity' value='0.03'/></emitter>";
  }
  return text +
         "<shape type='cube'><transform name='to_world'><scale value='0.12'/><rotate x='1' y='1' "
         "angle='40'/><translate x='-0.3' y='-0.2' z='0.5'/></transform>" +
         area + "</shape>";
}

struct Estimate {
  double mean, error;
};

Estimate mean_of(const TransportScene& s, const std::string& method,
                 const TransportScene::Parameters& parameters) {
  Moments m;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const Image image = s.render(method, parameters, 36, 100 + seed).image;
    double sum = 0;
    const size_t channels = image.channels.size();
    for (size_t i = 0; i < image.data.size(); i += channels) sum += double(image.data[i]);
    m.add(sum / double(image.data.size() / channels));
  }
  return {m.mean(), m.error()};
}

}  // namespace

TEST_CASE("images have the same mean by whatever lights are chosen") {
  const TransportScene tree(content("auto")), power(content("power"));
  REQUIRE(tree.scene->direct_picker.tree());
  REQUIRE(!power.scene->direct_picker.tree());
  for (const std::string method : {"path", "volpath", "direct", "bdpt", "reuse", "vcm"}) {
    CAPTURE(method);
    const TransportScene::Parameters parameters =
        method == "direct" ? TransportScene::Parameters{}
                           : TransportScene::Parameters{{"max_depth", "4"}};
    const Estimate a = mean_of(tree, method, parameters), b = mean_of(power, method, parameters);
    // A deviation of 3 % would be seen.
    const double error = std::hypot(a.error, b.error);
    CHECK(4 * error < 0.03 * b.mean);
    CHECK_MESSAGE(std::abs(a.mean - b.mean) < 4 * error, a.mean, " and ", b.mean, " ± ", error);
  }
}

TEST_CASE("a tree makes less noise where lights are many") {
  const auto noise = [](const std::string& selection) {
    const TransportScene s(content(selection));
    const Image many = s.render("direct", {}, 1024, 1).image;
    double sum = 0;
    for (uint64_t seed = 2; seed < 26; ++seed) {
      const Image few = s.render("direct", {}, 4, seed).image;
      for (size_t i = 0; i < few.data.size(); ++i)
        sum += std::pow(double(few.data[i]) - double(many.data[i]), 2);
    }
    return sum;
  };
  // Measured: 0.73, with an error of 0.05.
  CHECK(noise("auto") < 0.9 * noise("power"));
}
