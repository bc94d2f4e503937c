// An environment that is seen through a rectangle.
#include "lights/portal.h"

#include <doctest/doctest.h>

#include "lights/environment.h"
#include "math/sampler.h"
#include "pbrt/pbrt.h"
#include "support/flux.h"
#include "support/statistics.h"
#include "support/transport_scene.h"

using namespace duet;

namespace {

const Point3f kPortalCenter(2, -1, 5);
constexpr float kPortalRadius = 6;
/// Two by three, at x = 0; rays leave along −x.
const std::array<Point3f, 4> kCorners{Point3f(0, -2, 4), Point3f(0, 0, 4), Point3f(0, 0, 7),
                                      Point3f(0, -2, 7)};

std::unique_ptr<EnvironmentLight> constant() {
  return std::make_unique<ConstantEnvironment>(Spectrum(1, 2, 3));
}

/// A bright spot at −x, among texels that differ.
std::unique_ptr<EnvironmentLight> map() {
  std::vector<Spectrum> texels;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x) {
      const float v = 1 + float((x * 7 + y * 3) % 5) + (x == 11 && y == 4 ? 40.0f : 0.0f);
      texels.emplace_back(v, 0.5f * v, 0.2f * v);
    }
  return std::make_unique<EnvironmentMap>(16, 9, texels, Matrix4{});
}

void check_portal(std::unique_ptr<EnvironmentLight> environment, float share,
                  const std::string& name) {
  INFO(name);
  PortalEnvironment light(std::move(environment), kCorners, share);
  light.surround(kPortalCenter, kPortalRadius);
  for (const Point3f& from : {Point3f(1, -1, 5), Point3f(4, 2, 3)}) {
    const auto result = test::chi2_sphere(
        [&](float, Point2f v, Vector3f& d) {
          const auto s = light.sample_direct(from, v);
          if (s) d = s->wi;
          return s.has_value();
        },
        [&](const Vector3f& d) { return double(light.pdf_direct(from, d).value); },
        {.nx = 48, .ny = 32, .sub = 24, .samples = 100000});
    CHECK_MESSAGE(result.pass, result.message);
  }
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    if (const auto s = light.sample_direct(kPortalCenter, direction)) {
      CHECK(s->pdf.value ==
            doctest::Approx(light.pdf_direct(kPortalCenter, s->wi).value).epsilon(1e-3));
      CHECK(s->emission == light.emission_density(s->wi));
    }
    const auto e = light.sample_emission(position, direction);
    if (!e) continue;
    const Vector3f wi = -e->ray.direction;
    CHECK(dot(e->ray.origin - kPortalCenter, wi) > kPortalRadius);
    CHECK(e->density == light.emission_density(wi));
    // A point beyond the window, on the ray's way.
    const Point3f at = e->ray.origin + e->ray.direction * (2 * kPortalRadius);
    if (at.x > 0.01f) {
      CHECK(light.direct_density(*e, at) == light.pdf_direct(at, wi).value);
      for (int k = 0; k < 3; ++k)
        CHECK(e->weight[k] * e->density == doctest::Approx(light.emitted(at, wi)[k]).epsilon(4e-3));
    }
  }
  test::check_flux(light, {{1, -1, 5.5f}, {-1, 0, 0}, 0.8f}, name);
  test::check_flux(light, {{3, 0, 4}, {-1, 0.3f, 0.5f}, 1.5f}, name);
}

}  // namespace

TEST_CASE("portals let in the light that points find through them") {
  check_portal(constant(), 0, "constant");
  check_portal(map(), 0.5f, "map");
}

TEST_CASE("portals are dark but for rays that leave through their front") {
  const PortalEnvironment light(constant(), kCorners, 0);
  const Point3f inside(1, -1, 5.5f), outside(-1, -1, 5.5f);
  CHECK(light.emitted(inside, {-1, 0, 0}) == Spectrum(1, 2, 3));
  CHECK(light.emitted(inside, {1, 0, 0}).is_black());
  CHECK(light.emitted(outside, {1, 0, 0}).is_black());
  CHECK(light.emitted(outside, {-1, 0, 0}).is_black());
  CHECK_FALSE(light.sample_direct(outside, {0.5f, 0.5f}));
  // Beside each edge.
  for (const auto& [y, z] :
       {std::pair{-2.01f, 5.0f}, {0.01f, 5.0f}, {-1.0f, 3.99f}, {-1.0f, 7.01f}})
    CHECK(light.emitted({1, y, z}, {-1, 0, 0}).is_black());
  for (const auto& [y, z] :
       {std::pair{-1.99f, 5.0f}, {-0.01f, 5.0f}, {-1.0f, 4.01f}, {-1.0f, 6.99f}})
    CHECK_FALSE(light.emitted({1, y, z}, {-1, 0, 0}).is_black());
  // Radiance 2 in luminance's place through 6 units of area.
  CHECK(light.power(1) == doctest::Approx(6 * 3.14159265 * Spectrum(1, 2, 3).luminance()));
}

TEST_CASE("what stands before a portal stays dark, by all methods") {
  // A plate outside, seen from outside, in the way of half of the light; a floor inside.
  const std::string text =
      "LookAt -6 -4 4  0 0 1  0 0 1\nCamera \"perspective\" \"float fov\" 50\n"
      "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
      "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1] "
      "\"point3 portal\" [0 -1 0  0 1 0  0 1 2  0 -1 2]\n"
      "Material \"diffuse\" \"rgb reflectance\" [.8 .8 .8]\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0  -1 0 0  -1 -1 2  -1 0 2]\n"
      "Shape \"bilinearmesh\" \"point3 P\" [0 -3 0  4 -3 0  0 3 0  4 3 0]\n";
  const test::TemporaryDirectory folder;
  Diagnostics diagnostics;
  auto read = pbrt::read_pbrt(folder.write("portal.pbrt", text), {}, diagnostics);
  REQUIRE(read);
  const test::TransportScene scene(std::move(read->description));
  const auto mean = [&](const char* method) {
    Moments all;
    for (uint64_t seed = 0; seed < 16; ++seed) {
      const Image image = scene.render(method, {{"max_depth", "3"}}, 64, seed).image;
      double sum = 0;
      for (size_t i = 0; i < image.data.size(); i += 4) sum += double(image.data[i]);
      all.add(sum / 256);
    }
    return all;
  };
  const Moments path = mean("path");
  CHECK(path.error() < 0.01 * path.mean());
  for (const char* method : {"ptracer", "bdpt", "vcm"}) {
    CAPTURE(std::string(method));
    const Moments other = mean(method);
    CHECK(other.error() < 0.01 * path.mean());
    // Merging blurs.
    const double bias = std::string_view(method) == "vcm" ? 0.005 * path.mean() : 0.0;
    CHECK(std::abs(other.mean() - path.mean()) <
          bias + 5 * std::hypot(other.error(), path.error()));
  }
}
