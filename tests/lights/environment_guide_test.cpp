#include "lights/environment_guide.h"

#include <doctest/doctest.h>

#include "lights/environment.h"
#include "lights/guided_environment.h"
#include "math/sampler.h"
#include "math/statistics.h"

using namespace duet;

namespace {

/// A room of 4 × 6 × 3 with a window in its wall x = 2.
const BoxWalls kRoom(Bounds{{-2, -3, 0}, {2, 3, 3}});
const Point3f kPlaces[] = {{0, 0, 1}, {1, -2, 0.5f}, {-1.9f, 2, 2.5f}};

std::unique_ptr<EnvironmentLight> sky() {
  auto light = std::make_unique<ConstantEnvironment>(Spectrum(1, 2, 3));
  light->surround({}, 10);
  return light;
}

/// A bright spot among texels that differ.
std::unique_ptr<EnvironmentLight> sky_with_sun() {
  std::vector<Spectrum> texels;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x)
      texels.emplace_back(1 + float((x * 7 + y * 3) % 5) + (x == 4 && y == 3 ? 40.0f : 0.0f));
  auto light = std::make_unique<EnvironmentMap>(16, 9, texels, Matrix4{});
  light->surround({}, 10);
  return light;
}

Point3f window_point(Sampler& sampler) {
  return {2, -1 + sampler.next_1d(), 1 + sampler.next_1d()};
}

/// Learned from directions through the window, from all over the room.
EnvironmentGuide guide_to_window() {
  std::vector<EnvironmentGuide::Record> records;
  for (uint32_t i = 0; i < 4000; ++i) {
    Sampler sampler(SampleSequence::independent, 6, 0, 0);
    sampler.start_sample(i);
    const Point2f u = sampler.next_2d();
    const Point3f at(-1.9f + 3.8f * u.x, -2.9f + 5.8f * u.y, 2.9f * sampler.next_1d());
    records.push_back({at, normalize(window_point(sampler) - at), 1, {1}, {0.25f * kInvPi}});
  }
  return {kRoom, records};
}

void check_choice(std::unique_ptr<EnvironmentLight> light, const std::string& name) {
  CAPTURE(name);
  const float emission = light->emission_density({1, 0, 0});
  const GuidedEnvironment guided(std::move(light), guide_to_window());
  CHECK(guided.emission_density({1, 0, 0}) == emission);
  const Vector3f axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0.6f, 0.8f}, {0, -0.6f, -0.8f}};
  for (const Point3f& from : kPlaces) {
    // The integral of the cosine with an axis is π: a density that is 5 % off is noticed. Of walls
    // so near to a place densities have edges that a sum over directions cannot resolve.
    Moments found[std::size(axes)];
    for (uint32_t i = 0; i < 100000; ++i) {
      Sampler sampler(SampleSequence::independent, 7, 0, 0);
      sampler.start_sample(i);
      const auto s = guided.sample_direct(from, sampler.next_2d());
      REQUIRE(s);
      const PdfW pdf = guided.pdf_direct(from, s->wi);
      for (size_t k = 0; k < std::size(axes); ++k)
        found[k].add(double(std::max(dot(axes[k], s->wi), 0.0f) / pdf.value));
    }
    for (const Moments& m : found) {
      CAPTURE(m.mean());
      CAPTURE(m.error());
      CHECK(std::abs(m.mean() - double(kPi)) < 4 * m.error());
      CHECK(m.error() < 0.04);
    }
    Sampler sampler(SampleSequence::independent, 3, 0, 0);
    for (uint32_t i = 0; i < 1000; ++i) {
      sampler.start_sample(i);
      const auto s = guided.sample_direct(from, sampler.next_2d());
      REQUIRE(s);
      CHECK(s->emission == doctest::Approx(guided.emission_density(s->wi)));
      const Spectrum radiance = guided.emitted(from, s->wi);
      CHECK(s->weight.g * s->pdf.value == doctest::Approx(radiance.g).epsilon(1e-5));
      CHECK_FALSE(s->finite);
    }
  }
}

}  // namespace

TEST_CASE("rays leave a box by the cell that they were sent to") {
  Sampler sampler(SampleSequence::independent, 2, 0, 0);
  double mean[3] = {};
  constexpr uint32_t kRays = 40000;
  for (uint32_t i = 0; i < kRays; ++i) {
    sampler.start_sample(i);
    const uint32_t cell = i * 7 % BoxWalls::kCells;
    const Point2f u = sampler.next_2d();
    const Vector3f any = square_to_sphere(sampler.next_2d());
    for (int k = 0; k < 3; ++k) {
      const Point3f& from = kPlaces[k];
      const Vector3f d = kRoom.point(cell, {0.1f + 0.8f * u.x, 0.1f + 0.8f * u.y}) - from;
      const Vector3f wi = normalize(d);
      const BoxWalls::Exit e = kRoom.exit(from, wi);
      REQUIRE(e.cell() == cell);
      const int axis = BoxWalls::axis_of(cell);
      REQUIRE(e.pdf_of_cell ==
              doctest::Approx(kRoom.pdf_of_cell(axis, length_squared(d), std::abs(wi[axis])))
                  .epsilon(1e-3));
      mean[k] += double(kRoom.exit(from, any).pdf_of_cell) / (double(BoxWalls::kCells) * kRays);
    }
  }
  // Densities of cells that are all as probable, over the sphere. From corners they vary more.
  CHECK(4 * double(kPi) * mean[0] == doctest::Approx(1).epsilon(0.02));
  CHECK(4 * double(kPi) * mean[2] == doctest::Approx(1).epsilon(0.2));
  for (const float zero : {0.0f, -0.0f}) CHECK(kRoom.exit({0, 0, 1}, {zero, zero, 1}).wall == 5);
}

TEST_CASE("guided directions have the density that is told") {
  check_choice(sky(), "sky");
  check_choice(sky_with_sun(), "sky with sun");
}

TEST_CASE("a guide sends light samples through the window, from everywhere in the room") {
  const auto light = sky();
  const EnvironmentGuide guide = guide_to_window();
  for (const Point3f& from : kPlaces) {
    int through = 0;
    for (uint32_t i = 0; i < 1000; ++i) {
      Sampler sampler(SampleSequence::independent, 4, 0, 0);
      sampler.start_sample(i);
      const Vector3f wi = guide.sample_direct(*light, from, sampler.next_2d())->wi;
      const Point3f p = from + wi * ((2 - from.x) / wi.x);
      through += wi.x > 0 && p.y > -1.1f && p.y < 0.1f && p.z > 0.9f && p.z < 2.1f;
    }
    CHECK(through > 650);
  }
  // Outside of the room the environment chooses.
  const Point3f outside(3, 0, 1);
  const Point2f u{0.3f, 0.6f};
  CHECK(guide.sample_direct(*light, outside, u)->wi == light->sample_direct(outside, u)->wi);
  CHECK(guide.pdf(*light, outside, {1, 0, 0}).value == light->pdf_direct(outside, {1, 0, 0}).value);
}

TEST_CASE("where the environment's own choice is better, it makes most of the choices") {
  std::vector<EnvironmentGuide::Record> records;
  for (uint32_t i = 0; i < 4000; ++i) {
    Sampler sampler(SampleSequence::independent, 6, 0, 0);
    sampler.start_sample(i);
    const Point3f at(0, -1 + 2 * sampler.next_1d(), 1);
    // The sun, which the environment finds with a high density, from wherever it is seen.
    records.push_back({at, normalize(Vector3f(1, 0.1f, 0.2f)), 1, {1}, {1000}});
  }
  const EnvironmentGuide guide(kRoom, records);
  CHECK(guide.moment(records) > 1);
  CHECK(guide.moment(records) < 1.4);
}
