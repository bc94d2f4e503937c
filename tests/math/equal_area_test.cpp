// The map of equal areas between sphere and square.
#include "math/equal_area.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("the equal-area map has its axes where they are said to be") {
  const auto at = [](float x, float y) { return square_to_sphere_equal_area({x, y}); };
  CHECK(double(at(0.5f, 0.5f).z) == doctest::Approx(1));
  CHECK(double(at(0, 0).z) == doctest::Approx(-1));
  CHECK(double(at(1, 0.5f).x) == doctest::Approx(1));
  CHECK(double(at(0.5f, 1).y) == doctest::Approx(1));
}

TEST_CASE("the equal-area map goes to the sphere and back, and keeps areas") {
  constexpr int kN = 64;
  for (int j = 0; j < kN; ++j)
    for (int i = 0; i < kN; ++i) {
      const auto at = [&](float dx, float dy) {
        return Point2f{(float(i) + dx) / kN, (float(j) + dy) / kN};
      };
      const Point2f p = at(0.3f, 0.6f);
      const Vector3f w = square_to_sphere_equal_area(p);
      CHECK(double(length(w)) == doctest::Approx(1).epsilon(1e-5));
      const Point2f back = sphere_to_square_equal_area(w);
      CHECK(std::abs(back.x - p.x) < 1e-4f);
      CHECK(std::abs(back.y - p.y) < 1e-4f);
      const Vector3f a = square_to_sphere_equal_area(at(0.1f, 0.1f)),
                     b = square_to_sphere_equal_area(at(0.9f, 0.1f)),
                     c = square_to_sphere_equal_area(at(0.1f, 0.9f));
      const double area = double(length(cross(b - a, c - a)));
      CHECK(area == doctest::Approx(0.64 * 4 * 3.14159265 / (kN * kN)).epsilon(0.05));
    }
}
