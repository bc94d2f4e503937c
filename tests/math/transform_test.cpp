// Matrices of scene descriptions.
#include "math/transform.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace duet;

using Triple = std::array<double, 3>;

namespace {

void check_near(const Triple& a, const Triple& b) {
  for (size_t i = 0; i < 3; ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-12));
}

}  // namespace

TEST_CASE("transform: directions turn and stretch, but do not move") {
  const Matrix4 m =
      Matrix4::translate(5, 6, 7) * Matrix4::rotate(90, 0, 0, 1) * Matrix4::scale(1, 2, 3);
  check_near(m.turned({1, 0, 0}), {0, 1, 0});
  check_near(m.turned({0, 1, 0}), {-2, 0, 0});
  check_near(m.turned({0, 0, 1}), {0, 0, 3});
}

TEST_CASE("transform: what looks along a direction has it as +z, from its origin") {
  for (const Triple& d : {Triple{1, 0, 0}, Triple{0, -2, 0}, Triple{0, 0, 1}, Triple{1, 2, -3}}) {
    const auto m = Matrix4::look_along({1, 2, 3}, d);
    REQUIRE(m);
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    check_near(m->turned({0, 0, length}), d);
    check_near({(*m)[0][3], (*m)[1][3], (*m)[2][3]}, {1, 2, 3});
    CHECK(m->determinant3() == doctest::Approx(1));
  }
  CHECK(!Matrix4::look_along({1, 2, 3}, {0, 0, 0}));
}

TEST_CASE("transform: Rodrigues' formula turns about a unit axis and stretches with another") {
  const Matrix4 unit = Matrix4::rotate_by_formula(30, 0, 0.6, 0.8);
  const Matrix4 same = Matrix4::rotate(30, 0, 3, 4);
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) CHECK(unit[i][j] == doctest::Approx(same[i][j]));
  CHECK(Matrix4::rotate_by_formula(30, 0, 0, 2).determinant3() > 1.1);
  CHECK(Matrix4::rotate(30, 0, 0, 0) == Matrix4{});
}
