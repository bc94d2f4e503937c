// From points of the scene to the film: the way that camera rays go, backwards.
#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "math/sampler.h"

using namespace duet;

namespace {

constexpr Point2i kFilm{60, 40};
constexpr double kNear = 0.5, kFar = 12;

struct View {
  std::string name;
  Transform to_world;
  std::unique_ptr<Camera> camera;
};

/// Every kind of camera under transforms that move, stretch, shear and mirror.
std::vector<View> views() {
  const Matrix4 place = Matrix4::translate(1, -2, 3) * Matrix4::rotate(70, 1, 2, 3);
  Matrix4 shear;
  shear[0][2] = 0.3, shear[1][0] = 0.4, shear[2][1] = -0.2;
  const std::pair<const char*, Matrix4> places[] = {
      {"placed", place},
      {"stretched", place * Matrix4::scale(1.5, 0.8, 1.2)},
      {"mirrored", place * Matrix4::scale(-1, 1, 1)},
      {"sheared and mirrored", place * shear * Matrix4::scale(1.3, -0.7, 0.9)}};
  std::vector<View> views;
  for (const auto& [how, matrix] : places) {
    const Transform t(matrix);
    const auto add = [&, how = how](const std::string& kind, std::unique_ptr<Camera> camera) {
      views.push_back({kind + ", " + how, t, std::move(camera)});
    };
    const PerspectiveView centered{t, kFilm, 50, 0, 0, kNear, kFar};
    const PerspectiveView shifted{t, kFilm, 70, 0.2, -0.3, kNear, kFar};
    add("pinhole", std::make_unique<PerspectiveCamera>(centered));
    add("pinhole with a shifted centre", std::make_unique<PerspectiveCamera>(shifted));
    add("thin lens", std::make_unique<ThinLensCamera>(centered, ThinLens{0.3, 4}));
    add("thin lens with a shifted centre",
        std::make_unique<ThinLensCamera>(shifted, ThinLens{0.2, 6}));
    add("thin lens with an elliptic aperture",
        std::make_unique<ThinLensCamera>(centered, ThinLens{0.3, 4, 0.5}));
    if (std::string(how) == "placed" || std::string(how) == "mirrored") {
      add("barrel distortion", std::make_unique<DistortedCamera>(centered, 0.1, 0.05));
      add("pincushion distortion", std::make_unique<DistortedCamera>(centered, -0.1, 0.02));
    }
    add("orthographic",
        std::make_unique<OrthographicCamera>(OrthographicView{t, kFilm, kNear, kFar}));
  }
  return views;
}

using Visit = std::function<void(const View&, Sampler&)>;

void for_each_view(int samples, const Visit& visit) {
  for (const View& v : views()) {
    INFO(v.name);
    Sampler sampler(SampleSequence::independent, 8, 0, 0);
    for (int i = 0; i < samples; ++i) {
      sampler.start_sample(uint32_t(i));
      visit(v, sampler);
    }
  }
}

/// A position on the film, not at its very edge.
Point2f film_position(Sampler& sampler) {
  const Point2f u = sampler.next_2d();
  return {0.01f + u.x * (float(kFilm.x) - 0.02f), 0.01f + u.y * (float(kFilm.y) - 0.02f)};
}

float depth(float from, float to, float u) {
  return from + u * (to - from);
}

}  // namespace

TEST_CASE("points on a camera ray are seen where the ray came from") {
  for_each_view(500, [](const View& v, Sampler& sampler) {
    const Point2f film = film_position(sampler), lens = sampler.next_2d();
    const Ray ray = v.camera->sample_ray(film, lens);
    const float t = depth(0.01f, 0.99f, sampler.next_1d()) * ray.tmax;
    const auto s = v.camera->sample_lens(ray.origin + ray.direction * t, lens);
    REQUIRE(s);
    CHECK(std::abs(s->film.x - film.x) < 2e-3f);
    CHECK(std::abs(s->film.y - film.y) < 2e-3f);
    CHECK(max_abs(s->direction + ray.direction) < 1e-5f);
    CHECK(max_abs(s->target - ray.origin) < 1e-5f);
    CHECK(s->importance == doctest::Approx(v.camera->importance(ray, t)).epsilon(1e-4));
  });
}

TEST_CASE("importance is the density with which neighbouring rays arrive") {
  for_each_view(300, [](const View& v, Sampler& sampler) {
    const Point2f film = film_position(sampler), lens = sampler.next_2d();
    const Ray ray = v.camera->sample_ray(film, lens);
    const float t = sampler.next_1d() * ray.tmax;
    const Point3f center = ray.origin + ray.direction * t;
    // Where another film position arrives in the plane across the ray.
    const auto arrival = [&](float dx, float dy) {
      const Ray other = v.camera->sample_ray({film.x + dx, film.y + dy}, lens);
      const float s =
          dot(center - other.origin, ray.direction) / dot(other.direction, ray.direction);
      return (other.origin + other.direction * s) - center;
    };
    const Vector3f by_x = arrival(0.5f, 0) - arrival(-0.5f, 0),
                   by_y = arrival(0, 0.5f) - arrival(0, -0.5f);
    CHECK(double(v.camera->importance(ray, t)) * double(length(cross(by_x, by_y))) ==
          doctest::Approx(1).epsilon(3e-3));
  });
}

TEST_CASE("importance integrates to the film's area over any plane") {
  for (const View& v : views()) {
    INFO(v.name);
    Sampler sampler(SampleSequence::sobol, 8, 0, 0);
    // A rectangle across the view, wide enough for all that the camera sees there.
    const bool parallel = v.name.starts_with("orthographic");
    const float z = 3, size = parallel ? 1.5f : 9;
    const Vector3f x = v.to_world(Vector3f(2 * size, 0, 0)),
                   y = v.to_world(Vector3f(0, 2 * size, 0));
    const Point3f corner = v.to_world(Point3f(-size, -size, z));
    const Vector3f normal = cross(x, y);
    const int n = 1 << 16;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      sampler.start_sample(uint32_t(i));
      const Point2f u = sampler.next_2d();
      const auto s = v.camera->sample_lens(corner + (x * u.x + y * u.y), sampler.next_2d());
      if (s) sum += double(s->importance) * std::abs(double(dot(s->direction, normal)));
    }
    CHECK(sum / n == doctest::Approx(kFilm.x * kFilm.y).epsilon(0.01));
  }
}

TEST_CASE("points outside of the view are not seen") {
  for_each_view(100, [](const View& v, Sampler& sampler) {
    const Point2f film = film_position(sampler), lens = sampler.next_2d();
    const Ray ray = v.camera->sample_ray(film, lens);
    const auto sees = [&](const Ray& r, float t) {
      return v.camera->sample_lens(r.origin + r.direction * t, lens).has_value();
    };
    const float inside = ray.tmax * depth(0.1f, 0.9f, sampler.next_1d());
    CHECK(sees(ray, inside));
    // Before the near plane, behind the camera, beyond the far plane.
    CHECK(sees(ray, 1e-3f * ray.tmax));
    CHECK_FALSE(sees(ray, -1e-3f * ray.tmax));
    CHECK_FALSE(sees(ray, -ray.tmax));
    CHECK(sees(ray, 0.999f * ray.tmax));
    CHECK_FALSE(sees(ray, 1.001f * ray.tmax));
    // Past each edge of the film.
    const float w = float(kFilm.x), h = float(kFilm.y);
    for (const Point2f p : {Point2f{-0.1f, film.y}, Point2f{w + 0.1f, film.y},
                            Point2f{film.x, -0.1f}, Point2f{film.x, h + 0.1f}})
      CHECK_FALSE(sees(v.camera->sample_ray(p, lens), inside));
  });
}
