// Ambient occlusion where it is known.
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A floor that the camera sees alone, and a wall behind the camera without end for such a floor.
TransportScene corner() {
  return TransportScene(
      camera_xml("0, 0.5, 1", "0, 1.5, 0", 8) +
      "<shape type='rectangle'><transform name='to_world'><scale value='100'/></transform></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='1e5'/>"
      "<rotate x='1' angle='-90'/></transform></shape>");
}

double mean(const TransportScene& scene, const TransportScene::Parameters& parameters) {
  const Image image = scene.render("ao", parameters, 256, 1).image;
  double sum = 0;
  for (size_t i = 0; i < image.data.size(); i += 4) sum += double(image.data[i]);
  return sum / double(image.data.size() / 4);
}

}  // namespace

TEST_CASE("a wall hides half of the sky, if rays reach it") {
  const TransportScene scene = corner();
  CHECK(mean(scene, {{"ray_length", "1e7"}}) == doctest::Approx(0.5).epsilon(0.01));
  CHECK(mean(scene, {{"ray_length", "1e7"}, {"shading_samples", "3"}}) ==
        doctest::Approx(0.5).epsilon(0.01));
  CHECK(mean(scene, {{"ray_length", "1e-3"}}) == 1);
  // The scene is large, and so are its rays by themselves.
  CHECK(mean(scene, {}) == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("nothing is hidden where there is nothing, and all within a ball") {
  const TransportScene empty(camera_xml("0, 3, 0", "0, 9, 0", 4) + sphere_xml("0, 0, 0", "1", ""));
  CHECK(mean(empty, {}) == 1);
  const std::string inwards =
      "<shape type='sphere'><boolean name='flip_normals' value='true'/></shape>";
  const TransportScene ball(camera_xml("0, 0, 0", "1, 0, 0", 4) + inwards);
  CHECK(mean(ball, {{"ray_length", "10"}}) == 0);
}
