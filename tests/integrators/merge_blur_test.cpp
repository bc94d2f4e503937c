// What the shift of a photon to the vertex with which it is merged says, against closed forms.
#include "integrators/merge_blur.h"

#include <cmath>

#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kFloor =
    "<shape type='rectangle'><transform name='to_world'><scale value='4'/></transform>";
const std::string kSmallCamera = camera_xml("0, -3, 1", "0, 0, 1", 8);
const Point3f kLight{0, 0, 1};

/// The floor seen from above at a place.
PathVertex floor_at(const Scene& scene, float x, const Vector3f& towards_eye = {0, 0, 1}) {
  const Ray ray{Point3f{x, 0, 0} + towards_eye * 0.01f, towards_eye * -1, INFINITY};
  Hit hit;
  REQUIRE(scene.accel->closest_hit(ray, hit));
  return PathVertex(scene, scene.surface(ray, hit), towards_eye, Spectrum(1), {}, 1);
}

float blur(const TransportScene& s, const PathVertex& eye, float photon,
           const PhotonShift& shift = {}) {
  RenderCounters counters;
  return merge_blur(*s.scene, eye, {photon, 0, 0}, {kLight, Normal3f(0, 0, 1), {}}, shift,
                    counters);
}

/// Of a point light of height 1 on the floor.
double irradiance(double x) {
  return std::pow(1 + x * x, -1.5);
}

}  // namespace

TEST_CASE("a photon is too bright by the ratio of the irradiances") {
  const TransportScene s(kSmallCamera + kFloor + grey("0.5, 0.5, 0.5") + "</shape>" +
                         lamp_xml("0.1", "1"));
  for (const float x : {0.0f, 0.4f, 1.5f})
    for (const float beside : {-0.2f, -0.01f, 0.0f, 0.05f, 0.2f}) {
      const PathVertex eye = floor_at(*s.scene, x);
      const double all = 1 - irradiance(double(x)) / irradiance(double(x + beside));
      const double half = 1 - irradiance(double(x)) / irradiance(double(x + beside / 2));
      CHECK(double(blur(s, eye, x + beside)) == doctest::Approx(all).epsilon(1e-3));
      CHECK(double(blur(s, eye, x + beside, {0.5f, 0})) == doctest::Approx(half).epsilon(1e-3));
    }
}

TEST_CASE("a vertex in the photon's shadow gets all of it too much") {
  const std::string blocker =
      "<shape type='rectangle'><transform name='to_world'><scale value='0.1'/>"
      "<translate x='0.5' z='0.5'/></transform>" +
      grey("0.5, 0.5, 0.5") + "</shape>";
  const TransportScene s(kSmallCamera + kFloor + grey("0.5, 0.5, 0.5") + "</shape>" + blocker +
                         lamp_xml("0.1", "1"));
  const PathVertex dark = floor_at(*s.scene, 1), lit = floor_at(*s.scene, 1.3f);
  CHECK(blur(s, dark, 1.3f) == 1);
  CHECK(blur(s, lit, 1.35f) < 0.2f);
  // With a tenth of the radius, one edge in ten is still between the two.
  CHECK(blur(s, dark, 1.3f, {0.1f, 0.05f}) == 1);
  CHECK(blur(s, dark, 1.3f, {0.1f, 0.15f}) < 0.1f);
}

// Seen from where the mirror direction of the light is, the floor is bright in one place only.
TEST_CASE("a narrow lobe makes photons beside the highlight too bright or too dark") {
  const auto floor = [](const std::string& alpha) {
    return TransportScene(kSmallCamera + kFloor +
                          "<bsdf type='roughconductor'><float name='alpha' value='" + alpha +
                          "'/></bsdf></shape>" + lamp_xml("0.1", "1"));
  };
  const TransportScene narrow = floor("0.06"), wide = floor("0.5");
  const Vector3f up_left = Vector3f(-1, 0, 1) * float(std::sqrt(0.5));
  const auto both_sides = [&](const TransportScene& s, float x) {
    const PathVertex eye = floor_at(*s.scene, x, up_left);
    return std::pair(blur(s, eye, x - 0.05f), blur(s, eye, x + 0.05f));
  };
  // The highlight is at x = −1.
  const auto beside = both_sides(narrow, -0.8f);
  CHECK(beside.first > 0.1f);
  CHECK(beside.second < -0.1f);
  const auto smooth = both_sides(wide, -0.8f);
  CHECK(std::abs(smooth.first) < 0.1f);
  const auto on_top = both_sides(narrow, -1);
  CHECK(on_top.first + on_top.second < -0.05f);
  CHECK(on_top.first >= -1);
}

TEST_CASE("photons are missing in corners and beyond edges, by the share of the disk") {
  const std::string wall =
      "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='90'/>"
      "<translate x='2'/></transform>" +
      grey("0.5, 0.5, 0.5") + "</shape>";
  const TransportScene s(kSmallCamera + kFloor + grey("0.5, 0.5, 0.5") + "</shape>" + wall +
                         lamp_xml("0.1", "1"));
  const auto missing = [&](float x) {
    const PathVertex eye = floor_at(*s.scene, x);
    RenderCounters counters;
    int sum = 0;
    for (int i = 0; i < 4096; ++i)
      sum += lacks_photons(*s.scene, eye, 0.1f,
                           {(float(i % 64) + 0.5f) / 64, (float(i / 64) + 0.5f) / 64}, counters);
    return sum / 4096.0;
  };
  // Of a disk at half its radius from a straight line.
  const double beyond = (kPi / 3 - std::sqrt(3) / 4) / kPi;
  CHECK(missing(0) == 0);
  CHECK(missing(1.95f) == doctest::Approx(beyond).epsilon(0.01));  // the wall
  CHECK(missing(3.95f) == doctest::Approx(beyond).epsilon(0.01));  // the end of the floor
  CHECK(missing(3.999f) == doctest::Approx(0.5).epsilon(0.03));
}
