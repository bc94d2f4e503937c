// Lens systems against geometrical optics, and what cameras make of them.
#include "cameras/realistic.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "cameras/perspective.h"
#include "math/sampler.h"

using namespace duet;

namespace {

constexpr double kPiD = std::numbers::pi;

/// A biconvex lens of focal length 50 mm, thin but for what its surfaces need.
std::vector<LensSurface> thin_lens(double aperture) {
  return {{0, 1e-9, 1, aperture}, {0.05, 1e-6, 1.5, 0.02}, {-0.05, 0, 1, 0.02}};
}

/// Of the kind of a double Gauss lens, with the stop in its middle.
std::vector<LensSurface> double_gauss(double aperture) {
  std::vector<LensSurface> s{
      {29.475, 3.76, 1.67, 12.6},  {84.83, 0.12, 1, 12.6},    {19.275, 4.025, 1.67, 11.5},
      {40.77, 3.275, 1.699, 11.5}, {12.75, 5.705, 1, 9},      {0, 4.5, 1, 1e3 * aperture},
      {-14.495, 1.18, 1.603, 8.5}, {40.77, 6.065, 1.658, 10}, {-20.385, 0.19, 1, 10},
      {437.065, 3.22, 1.717, 10},  {-39.73, 0, 1, 10}};
  for (LensSurface& l : s) l = {1e-3 * l.radius, 1e-3 * l.thickness, l.ior, 1e-3 * l.aperture};
  return s;
}

LensSystem focused(std::vector<LensSurface> surfaces, double distance, LensStop stop = {}) {
  LensSystem lens(std::move(surfaces), std::move(stop));
  const auto film = lens.film_distance_for(distance);
  REQUIRE(film);
  lens.set_film_distance(*film);
  return lens;
}

/// The mean weight of the rays through a film position.
double mean_weight(const Camera& camera, const Point2f& film) {
  constexpr int kSide = 400;
  double sum = 0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      sum += double(
          camera.sample_ray(film, {(float(i) + 0.5f) / kSide, (float(j) + 0.5f) / kSide}).weight);
  return sum / (kSide * kSide);
}

/// The irradiance that a disk of radiance 1 makes on a parallel plane at the distance `height`, at
/// `aside` from its axis. Source: the configuration factor of a disk, e.g. Howell's catalogue B-15.
double irradiance_of_disk(double radius, double height, double aside) {
  if (aside == 0) return kPiD * sqr(radius) / (sqr(radius) + sqr(height));
  const double h = height / aside, r = radius / aside, z = 1 + h * h + r * r;
  return 0.5 * kPiD * (1 - (z - 2 * r * r) / std::sqrt(z * z - 4 * r * r));
}

/// Where a ray meets a plane across the axis.
std::array<double, 2> at_depth(const Ray& ray, double z) {
  const double t = (z - double(ray.origin.z)) / double(ray.direction.z);
  return {double(ray.origin.x) + t * double(ray.direction.x),
          double(ray.origin.y) + t * double(ray.direction.y)};
}

}  // namespace

TEST_CASE("realistic camera: a stop without lenses lights the film as a disk does") {
  // The film is 24 x 18 mm; the stop is 50 mm away and reaches over 20 mm.
  const RealisticCamera camera({}, {40, 30}, 0.03, LensSystem({{0, 0.05, 1, 0.01}}), false);
  for (const Point2f film : {Point2f{20, 15}, Point2f{30, 15}, Point2f{3, 28}, Point2f{20, 1}}) {
    const double aside = 0.0006 * std::hypot(double(film.x) - 20, double(film.y) - 15);
    CHECK(mean_weight(camera, film) ==
          doctest::Approx(irradiance_of_disk(0.01, 0.05, aside)).epsilon(0.003));
  }
}

TEST_CASE("realistic camera: a thin lens has its focal length") {
  // 1 / 50 mm = (1.5 - 1) (1 / 50 mm + 1 / 50 mm); object and image are 2 m apart.
  const double image = *LensSystem(thin_lens(0.002)).film_distance_for(2);
  CHECK(1 / image + 1 / (2 - image) == doctest::Approx(1 / 0.05).epsilon(1e-4));
  // Nearer than four focal lengths nothing can be sharp.
  CHECK(LensSystem(thin_lens(0.002)).film_distance_for(0.201));
  CHECK_FALSE(LensSystem(thin_lens(0.002)).film_distance_for(0.199));
  CHECK_FALSE(LensSystem({{0, 0.05, 1, 0.01}}).film_distance_for(2));
  CHECK_FALSE(LensSystem({{-0.05, 1e-6, 1.5, 0.02}, {0.05, 0, 1, 0.02}}).film_distance_for(2));
}

TEST_CASE("realistic camera: lenses show what a thin lens shows, in focus where they are set") {
  for (const bool thick : {false, true}) {
    CAPTURE(thick);
    const LensSystem lens = focused(thick ? double_gauss(0.002) : thin_lens(0.002), 2);
    const RealisticCamera camera({}, {40, 30}, 0.005, lens, false);
    Sampler sampler(SampleSequence::independent, 5, 0, 0);
    for (int i = 0; i < 40; ++i) {
      sampler.start_sample(uint32_t(i));
      const Point2f u = sampler.next_2d(), film{40 * u.x, 30 * u.y};
      // All rays from a film point meet in the plane of focus.
      std::array<double, 2> low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
      for (int k = 0; k < 64; ++k) {
        const CameraRay ray = camera.sample_ray(film, sampler.next_2d());
        if (ray.weight == 0) continue;
        const auto p = at_depth(ray, 2);
        for (size_t c = 0; c < 2; ++c)
          low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
      }
      REQUIRE(high[0] >= low[0]);
      // The image is 4 mm wide on the film, 0.15 m in the scene, and the aperture 4 mm.
      CHECK(high[0] - low[0] < 2e-4);
      CHECK(high[1] - low[1] < 2e-4);
      if (thick) continue;
      const double image = lens.film_distance(), object = 2 - image;
      const PerspectiveView view{Transform(Matrix4::translate(0, 0, image)),
                                 {40, 30},
                                 2 * std::atan(0.002 / image) * 180 / kPiD};
      const ThinLensCamera model(view, ThinLens{0.002, object});
      const auto p = at_depth(model.sample_ray(film, sampler.next_2d()), 2);
      for (size_t c = 0; c < 2; ++c) CHECK(std::abs(0.5 * (low[c] + high[c]) - p[c]) < 2e-4);
    }
  }
}

TEST_CASE("realistic camera: all light that passes the lenses is within the pupil's bounds") {
  Sampler sampler(SampleSequence::independent, 7, 0, 0);
  for (const double aperture : {0.00855, 0.003, 0.0001}) {
    CAPTURE(aperture);
    const LensSystem lens = focused(double_gauss(aperture), 3);
    const ExitPupil pupil(lens, 0.0215);
    REQUIRE_FALSE(pupil.empty());
    const double side = 1.2 * lens.rear_aperture(), depth = lens.film_distance();
    int passed = 0, used = 0, tried = 0;
    for (int i = 0; i < 40000; ++i) {
      sampler.start_sample(uint32_t(i));
      const double film = 0.0215 * double(sampler.next_1d());
      const Point2f u = sampler.next_2d(), v = sampler.next_2d();
      const ExitPupil::Box& box = pupil.at(film);
      const auto passes = [&](double x, double y) {
        const double dx = x - film, l = std::sqrt(dx * dx + y * y + depth * depth);
        LensRay ray{{film, 0, 0}, {dx / l, y / l, depth / l}};
        return lens.trace(ray) > 0;
      };
      // Anywhere, and close to the bounds.
      const bool near = i % 2 != 0 && !box.empty();
      const double x = near ? box.x0 + (1.4 * double(u.x) - 0.2) * (box.x1 - box.x0)
                            : side * (2 * double(u.x) - 1);
      const double y = near ? 1.2 * (2 * double(u.y) - 1) * box.y : side * (2 * double(u.y) - 1);
      if (passes(x, y)) {
        ++passed;
        CHECK((x >= box.x0 && x <= box.x1 && std::abs(y) <= box.y));
      }
      if (box.empty()) continue;
      ++tried;
      used += passes(box.x0 + double(v.x) * (box.x1 - box.x0), (2 * double(v.y) - 1) * box.y);
    }
    CHECK(passed > 1000);
    // The bounds are not much wider than the pupil.
    CHECK(used > 0.4 * tried);
  }
}

TEST_CASE("realistic camera: no light passes where the lenses block it") {
  // Beyond the image that the rims leave: at 45 degrees behind a long tube.
  const RealisticCamera tube({}, {40, 40}, 0.3,
                             LensSystem({{0, 0.05, 1, 0.01}, {0, 0.05, 1, 0.01}}), false);
  CHECK(mean_weight(tube, {20, 20}) > 0);
  CHECK(mean_weight(tube, {1, 1}) == 0);
  CHECK_FALSE(tube.next_rays({1, 1}, {0.5f, 0.5f}));
  // The blocked ray is one nevertheless.
  CHECK(length(tube.sample_ray({1, 1}, {0.5f, 0.5f}).direction) == doctest::Approx(1));
  const ExitPupil none(LensSystem({{0, 0.05, 1, 1e-12}, {0.01, 0.05, 1, 1e-3}}), 0.02);
  CHECK(none.at(0.01).area() < 1e-12);
}

TEST_CASE("realistic camera: brightness that is relative to the pupil does not know the stop") {
  std::vector<double> centre;
  for (const double aperture : {0.008, 0.004, 0.001}) {
    const RealisticCamera camera({}, {30, 20}, 0.02, focused(double_gauss(aperture), 3), true);
    centre.push_back(mean_weight(camera, {15, 10}));
    const RealisticCamera other({}, {30, 20}, 0.02, focused(double_gauss(aperture), 3), false);
    // Both fall off alike.
    CHECK(mean_weight(camera, {1, 1}) / centre.back() ==
          doctest::Approx(mean_weight(other, {1, 1}) / mean_weight(other, {15, 10})).epsilon(0.02));
  }
  // A disk in a square with pbrt's margin, which is wide for small stops.
  CHECK(centre[0] == doctest::Approx(kPiD / 4).epsilon(0.08));
  CHECK(centre[1] == doctest::Approx(centre[0]).epsilon(0.06));
  CHECK(centre[2] < centre[1]);
}

TEST_CASE("realistic camera: stops of any shape let the same light pass") {
  std::vector<LensStop> stops;
  for (const StopShape s : {StopShape::disk, StopShape::gaussian, StopShape::square,
                            StopShape::pentagon, StopShape::star})
    stops.emplace_back(s);
  stops.emplace_back(2, 2, std::vector<float>{0, 1, 2, 3});
  for (size_t i = 0; i < stops.size(); ++i) {
    CAPTURE(i);
    constexpr int kSide = 800;
    double sum = 0, reach = 0;
    for (int j = 0; j < kSide; ++j)
      for (int k = 0; k < kSide; ++k) {
        const double x = 4 * (k + 0.5) / kSide - 2, y = 4 * (j + 0.5) / kSide - 2;
        const double t = stops[i].transmission(x, y);
        sum += t;
        if (t > 0) reach = std::max(reach, std::hypot(x, y));
      }
    CHECK(16 * sum / (kSide * kSide) == doctest::Approx(kPiD).epsilon(0.004));
    CHECK(reach <= stops[i].reach());
  }
  // The pentagon points down; the image's first row is above, its first column on the left.
  CHECK(stops[3].transmission(0, -0.75) > 0);
  CHECK(stops[3].transmission(0, 0.75) == 0);
  CHECK(stops[4].transmission(-0.9, 0) > 0);
  CHECK(stops[4].transmission(0.9, 0) == 0);
  CHECK(stops[5].transmission(0.5, 0.5) == doctest::Approx(kPiD / 4 / 1.5));
  CHECK(stops[5].transmission(-0.5, -0.5) == doctest::Approx(2 * kPiD / 4 / 1.5));
}

TEST_CASE("realistic camera: a stop's shape is that of what is out of focus") {
  // Far behind the plane of focus, the image of a point is the stop upside down; in front of it, as
  // seen along the ray, what passes the right of the stop comes from the right.
  const LensSystem lens = focused(double_gauss(0.004), 1, LensStop(2, 1, {0, 1}));
  const RealisticCamera camera({}, {30, 20}, 0.02, lens, false);
  Sampler sampler(SampleSequence::independent, 9, 0, 0);
  double right = 0, left = 0;
  for (int i = 0; i < 2000; ++i) {
    sampler.start_sample(uint32_t(i));
    const CameraRay ray = camera.sample_ray({15, 10}, sampler.next_2d());
    // Half-way to the plane of focus; +x is on the left of the image.
    (at_depth(ray, 0.5)[0] < 0 ? right : left) += double(ray.weight);
  }
  CHECK(right > 3 * left);
}
