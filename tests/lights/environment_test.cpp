#include "lights/environment.h"

#include <doctest/doctest.h>

#include "image/image_io.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/statistics.h"
#include "support/tables.h"
#include "support/transport_scene.h"

using namespace duet;

namespace {

std::vector<Spectrum> to_texels(const test::Json& pixels, float scale) {
  std::vector<Spectrum> texels;
  for (size_t i = 0; i < pixels.size(); i += 3)
    texels.push_back(test::triple<Spectrum>(pixels, i) * scale);
  return texels;
}

/// A map with a sun, black parts and a bright pole.
EnvironmentMap make_map(int width, int height, const Matrix4& to_world) {
  std::vector<Spectrum> texels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float v = float((x * 7 + y * 3) % 5);
      if (x > width / 2 && y > height / 2) v = 0;
      if (x == width / 3 && y == height / 3) v = 200;
      if (y == 0) v = 30;
      texels.emplace_back(v, 0.5f * v, 0.2f * v + 0.01f * float(x % 2));
    }
  return {width, height, texels, to_world};
}

void check_light(const EnvironmentLight& light, uint64_t seed) {
  const auto result = test::chi2_sphere(
      [&](float, Point2f v, Vector3f& d) {
        const auto s = light.sample_direct({}, v);
        if (!s) return false;
        d = s->wi;
        return true;
      },
      [&](const Vector3f& d) { return double(light.pdf_direct({}, d).value); },
      {.nx = 36, .ny = 24, .sub = 16, .samples = 200000, .seed = seed});
  CHECK_MESSAGE(result.pass, "seed " << seed << ": " << result.message);
  Sampler sampler(SampleSequence::sobol, seed, 0, 0);
  double power = 0, sampled = 0;
  const int n = 1 << 17;
  for (int i = 0; i < n; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f u = sampler.next_2d();
    const Vector3f w = square_to_sphere(u);
    power += double(light.emitted({}, w).luminance()) * 4 * 3.14159265 / n;
    if (light.emitted({}, w).luminance() > 0) CHECK(light.pdf_direct({}, w).value > 0);
    const auto s = light.sample_direct({}, u);
    if (!s) continue;
    CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-5));
    CHECK_FALSE(s->finite);
    CHECK_FALSE(s->delta);
    sampled += double(s->weight.luminance()) / n;
    if (i % 64) continue;
    // What the sample says is what a ray in its direction finds.
    CHECK(s->pdf.value == doctest::Approx(light.pdf_direct({}, s->wi).value).epsilon(2e-3));
    const Spectrum found = light.emitted({}, s->wi) / light.pdf_direct({}, s->wi).value;
    for (int k = 0; k < 3; ++k) CHECK(s->weight[k] == doctest::Approx(found[k]).epsilon(2e-3));
  }
  CHECK(sampled == doctest::Approx(power).epsilon(1e-2));
  CHECK(light.power(2) == doctest::Approx(power * 3.14159265 * 4).epsilon(2e-2));
}

}  // namespace

TEST_CASE("environment maps show what Mitsuba's show") {
  const test::Json table = test::read_table("lights");
  const int w = table["sky"]["width"], h = table["sky"]["height"];
  for (const test::Json& e : table["environments"]) {
    const EnvironmentMap light(w, h, to_texels(table["sky"]["pixels"], e["scale"]),
                               test::to_matrix(e["to_world"]));
    const Transform to_world(test::to_matrix(e["to_world"]));
    double ratio = 0;
    for (const test::Json& row : e["directions"]) {
      INFO(row.dump());
      const Vector3f d = test::triple<Vector3f>(row, 0);
      const Spectrum expected = test::triple<Spectrum>(row, 3), found = light.emitted({}, d);
      for (int k = 0; k < 3; ++k) CHECK(found[k] == doctest::Approx(expected[k]).epsilon(1e-4));
      // Duet samples the poles a little more often than Mitsuba: densities are in proportion
      // elsewhere.
      const double polar = std::acos(double(std::abs(to_world.inverse(d).y)));
      if (polar < 3.14159265 / (h - 1)) continue;
      const double r = double(light.pdf_direct({}, d).value) / row[6].get<double>();
      if (ratio == 0) ratio = r;
      CHECK(r == doctest::Approx(ratio).epsilon(1e-4));
      CHECK(r == doctest::Approx(1).epsilon(0.05));
    }
  }
}

TEST_CASE("environment lights are sampled as their densities say") {
  check_light(ConstantEnvironment(Spectrum(1, 2, 3)), 1);
  check_light(make_map(16, 9, Matrix4{}), 2);
  check_light(make_map(7, 12, Matrix4::rotate(50, 1, 2, 3) * Matrix4::scale(-2, 2, 2)), 3);
  check_light(make_map(2, 3, Matrix4{}), 4);
  check_light(EnvironmentMap(8, 5, std::vector<Spectrum>(40, Spectrum(2)), Matrix4{}), 5);
}

TEST_CASE("a light that shines only from the pole is found there") {
  std::vector<Spectrum> texels(64 * 32);
  for (size_t i = 0; i < 64; ++i) texels[i] = Spectrum(1000);
  const EnvironmentMap light(64, 32, texels, Matrix4{});
  Sampler sampler(SampleSequence::independent, 1, 0, 0);
  Moments moments;
  for (int i = 0; i < 20000; ++i) {
    sampler.start_sample(uint32_t(i));
    const auto s = light.sample_direct({}, sampler.next_2d());
    REQUIRE(s);
    CHECK(s->wi.y > 0.99f);
    moments.add(double(s->weight.r));
  }
  // ∫ (1 − θ/Δ) sin θ dθ dφ over the first row
  const double step = 3.14159265 / 31;
  CHECK(std::abs(moments.mean() - 2000 * 3.14159265 * (1 - std::sin(step) / step)) <
        5 * moments.error());
  CHECK(std::sqrt(moments.variance()) < 0.8 * moments.mean());
}

TEST_CASE("a black environment is no trouble") {
  const EnvironmentMap light(4, 3, std::vector<Spectrum>(12), Matrix4{});
  CHECK(light.power(1) == 0);
  CHECK(light.emitted({}, {0, 1, 0}).is_black());
  const auto s = light.sample_direct({}, {0.3f, 0.7f});
  REQUIRE(s);
  CHECK(s->weight.is_black());
}

TEST_CASE("environment maps of few pixels are enlarged by the nearest one, as Mitsuba does it") {
  const test::TemporaryDirectory folder;
  Image map(1, 2, {"R", "G", "B"});
  map.data = {1, 1, 1, 3, 3, 3};
  write_exr(folder.path("map.exr"), map, {});
  const test::TransportScene s(folder, test::camera_xml("0,-3,1", "0,0,1", 8) +
                                           "<emitter type='envmap'><string name='filename' "
                                           "value='map.exr'/></emitter>");
  const auto towards = [&](const Vector3f& w) { return s.scene->environment->emitted({}, w).g; };
  // Of three rows: at the upper pole, the horizon and the lower pole.
  CHECK(towards({0, 1, 0}) == doctest::Approx(1));
  CHECK(towards({1, 0, 0}) == doctest::Approx(3));
  CHECK(towards({0, 0, -1}) == doctest::Approx(3));
  CHECK(towards({0, -1, 0}) == doctest::Approx(3));
}
