// Poses between poses.
#include "math/motion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "math/polar.h"

using namespace duet;

namespace {

double difference(const Matrix4& a, const Matrix4& b) {
  double largest = 0;
  for (int i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j) largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
  return largest;
}

Matrix4 transposed3(const Matrix4& m) {
  Matrix4 t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t[i][size_t(j)] = m[j][size_t(i)];
  return t;
}

Motion motion(const Matrix4& a, const Matrix4& b) {
  return Motion({{1, a}, {3, b}});
}

}  // namespace

TEST_CASE("a linear map is a rotation after a symmetric map") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 200; ++n) {
    Matrix4 m;
    for (int i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) m[i][j] = normal(random);
    // Sizes of all orders, and stretches that differ by as much as transforms can.
    const double size = std::pow(10, n % 21 - 10);
    m = m * Matrix4::scale(size, size, size * (n % 3 ? 1 : 1e-4));
    m[0][3] = 5;
    const PolarParts p = polar_parts(m);
    CAPTURE(n);
    CHECK(difference(transposed3(p.rotation) * p.rotation, {}) < 1e-9);
    CHECK(p.rotation.determinant3() == doctest::Approx(1));
    Matrix4 product = p.rotation * p.stretch;
    product[0][3] = 5;
    CHECK(difference(product, m) < 1e-9 * size);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j)
        CHECK(std::abs(p.stretch[i][size_t(j)] - p.stretch[j][size_t(i)]) < 1e-9 * size);
    // Definite, negative if the map mirrors.
    CHECK(p.stretch.determinant3() * m.determinant3() > 0);
    CHECK((p.stretch[0][0] > 0) == (m.determinant3() > 0));
  }
}

TEST_CASE("translations and scales change linearly, rotations steadily") {
  const Motion moved = motion(Matrix4::translate(0, -2, 4), Matrix4::translate(8, 2, 0));
  CHECK(difference(moved.at(1.5), Matrix4::translate(2, -1, 3)) < 1e-15);
  const Motion grown = motion(Matrix4::scale(1, 2, 3), Matrix4::scale(3, 2, 1));
  CHECK(difference(grown.at(1.5), Matrix4::scale(1.5, 2, 2.5)) < 1e-14);
  for (const double angle : {1e-6, 0.01, 40.0, 90.0, 179.0}) {
    CAPTURE(angle);
    const Motion turned =
        motion(Matrix4::rotate(10, 1, -2, 3), Matrix4::rotate(10 + angle, 1, -2, 3));
    for (const double share : {0.1, 0.25, 0.5, 0.9})
      CHECK(difference(turned.at(1 + 2 * share), Matrix4::rotate(10 + share * angle, 1, -2, 3)) <
            1e-13);
  }
  // All at once, and mirrored.
  const auto pose = [](double share) {
    return Matrix4::translate(share, 0, 0) * Matrix4::rotate(60 * share, 0, 1, 0) *
           Matrix4::scale(-1 - share, 1, 2);
  };
  CHECK(difference(motion(pose(0), pose(1)).at(1.5), pose(0.25)) < 1e-14);
}

TEST_CASE("every axis: rotations from and to more than half a turn") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 300; ++n) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const double begin = 100 * normal(random), way = 170 * std::tanh(normal(random));
    const Motion turned =
        motion(Matrix4::rotate(begin, x, y, z), Matrix4::rotate(begin + way, x, y, z));
    CHECK(difference(turned.at(1.6), Matrix4::rotate(begin + 0.3 * way, x, y, z)) < 1e-12);
  }
}

TEST_CASE("rotations take the shorter way") {
  const Motion turned = motion({}, Matrix4::rotate(270, 0, 0, 1));
  CHECK(difference(turned.at(2), Matrix4::rotate(-45, 0, 0, 1)) < 1e-14);
}

TEST_CASE("stretches along other axes stay what they are") {
  const Matrix4 stretched =
      Matrix4::rotate(30, 1, 1, 0) * Matrix4::scale(1, 2, 4) * Matrix4::rotate(-30, 1, 1, 0);
  const Matrix4 turned = Matrix4::rotate(80, 0, 0, 1) * stretched;
  CHECK(difference(motion(stretched, turned).at(2), Matrix4::rotate(40, 0, 0, 1) * stretched) <
        1e-13);
}

TEST_CASE("a motion passes its poses exactly and begins and ends with them") {
  const Matrix4 a = Matrix4::rotate(20, 1, 2, 3) * Matrix4::scale(2, 3, 4),
                b = Matrix4::scale(1, 3, 1),
                c = Matrix4::translate(1, 2, 3) * Matrix4::rotate(77, 3, 2, 1);
  const Motion m({{-1, a}, {0.5, b}, {2, c}});
  CHECK(m.at(-100) == a);
  CHECK(m.at(-1) == a);
  CHECK(m.at(0.5) == b);
  CHECK(m.at(2) == c);
  CHECK(m.at(100) == c);
  CHECK(difference(m.at(0.5 + 1e-9), b) < 1e-8);
  CHECK(difference(m.at(0.5 - 1e-9), b) < 1e-8);
  CHECK(Motion().at(3) == Matrix4{});
}

TEST_CASE("whether anything moves in a time") {
  const Matrix4 here, there = Matrix4::translate(1, 0, 0);
  const Motion m({{0, here}, {1, here}, {2, there}, {3, here}});
  CHECK(Motion().is_still(0, 9));
  CHECK(m.is_still(-5, 1));
  CHECK(m.is_still(3, 9));
  CHECK(m.is_still(1.5, 1.5));
  CHECK_FALSE(m.is_still(0, 1.5));
  // There and back again.
  CHECK_FALSE(m.is_still(0, 3));
  CHECK_FALSE(m.is_still(-1, 9));
}
