// Merging keeps the mean of an image.
#include <cmath>
#include <numbers>

#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A ball of few flat faces with the normals of a sphere.
std::string coarse_ball_obj() {
  constexpr int kAround = 8, kDown = 4;
  std::string vertices, normals, faces;
  for (int j = 0; j <= kDown; ++j)
    for (int i = 0; i < kAround; ++i) {
      const double theta = std::numbers::pi * j / kDown, phi = 2 * std::numbers::pi * i / kAround;
      const std::string at = std::to_string(std::sin(theta) * std::cos(phi)) + " " +
                             std::to_string(std::sin(theta) * std::sin(phi)) + " " +
                             std::to_string(std::cos(theta)) + "\n";
      vertices += "v " + at, normals += "vn " + at;
    }
  const auto corner = [](int j, int i) {
    const std::string number = std::to_string(j * kAround + i % kAround + 1);
    return number + "//" + number + " ";
  };
  for (int j = 0; j < kDown; ++j)
    for (int i = 0; i < kAround; ++i)
      faces += "f " + corner(j, i) + corner(j + 1, i) + corner(j + 1, i + 1) +  //
               (j > 0 ? corner(j, i + 1) : "") + "\n";
  return vertices + normals + faces;
}

double mean_color(const Image& image) {
  const size_t channels = image.channels.size();
  double sum = 0;
  for (size_t i = 0; i < image.data.size(); i += channels)
    sum += double(image.data[i] + image.data[i + 1] + image.data[i + 2]);
  return sum;
}

}  // namespace

// Near the edges photons lie on faces that are turned by 45 degrees from that of the eye vertex.
// Counted by the latter they make the image 1.6 to 12 times as bright.
TEST_CASE("photons are counted by the faces on which they lie") {
  const TemporaryDirectory folder;
  folder.write("ball.obj", coarse_ball_obj());
  const TransportScene s(folder,
                         camera_xml("0,-0.65,0.75", "0,0,0.6", 16) +
                             "<shape type='obj'><string name='filename' value='ball.obj'/>"
                             "<transform name='to_world'><scale value='0.25'/><translate z='0.6'/>"
                             "</transform>" +
                             grey("0.7") + "</shape>" + lamp_xml("0.5", "5"));
  const double meant = mean_color(s.render("path", {}, 1024, 1).image);
  const TransportScene::Parameters parameters{
      {"radius", "0.05"}, {"alpha", "1"}, {"light_paths", "16"}};
  CHECK(mean_color(s.render("bpm", parameters, 256, 2).image) ==
        doctest::Approx(meant).epsilon(0.1));
}
