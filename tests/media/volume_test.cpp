// Lookups in grids.
#include <doctest/doctest.h>

#include "media/cloud.h"
#include "media/majorant_grid.h"
#include "media/random_stream.h"

using namespace duet;

namespace {

std::shared_ptr<const VolumeGrid> counting(std::array<int, 3> size, int channels = 1) {
  VolumeGrid grid;
  grid.size = size;
  grid.channels = channels;
  for (size_t i = 0; i < grid.node_count() * size_t(channels); ++i)
    grid.values.push_back(float(i + 1));
  return std::make_shared<VolumeGrid>(grid);
}

std::shared_ptr<const VolumeGrid> noise(std::array<int, 3> size, int channels, uint64_t seed) {
  VolumeGrid grid;
  grid.size = size;
  grid.channels = channels;
  RandomStream random(seed);
  for (size_t i = 0; i < grid.node_count() * size_t(channels); ++i)
    grid.values.push_back(random.next());
  return std::make_shared<VolumeGrid>(grid);
}

void check_traversal(const GridVolume& v) {
  const MajorantGrid majorants(v, 2);
  Point3f lower, upper;
  v.world_box(lower, upper);
  RandomStream random(5);
  for (int i = 0; i < 500; ++i) {
    const Point3f o(random.next() * 3 - 1, random.next() * 3 - 1, random.next() * 3 - 1);
    Vector3f d(random.next() * 2 - 1, random.next() * 2 - 1, random.next() * 2 - 1);
    if (i % 5 == 0) d[i % 3] = 0;
    float last = -1, inside = 0;
    const Point3f local_o = v.to_local(o);
    const Vector3f local_d = v.to_local(d);
    majorants.traverse({o, d, INFINITY}, local_o, local_d, [&](float t0, float t1, float majorant) {
      if (last >= 0) CHECK(t0 == last);
      CHECK(t1 > t0);
      last = t1;
      inside += t1 - t0;
      for (const float f : {0.1f, 0.5f, 0.9f})
        CHECK(2 * v.local_value(local_o + local_d * lerp(t0, t1, f)) <= majorant * 1.001f);
      return true;
    });
    // The length in the box, by its three slabs.
    float a = 0, b = INFINITY;
    for (int k = 0; k < 3; ++k) {
      if (d[k] == 0) {
        if (o[k] < lower[k] || o[k] > upper[k]) b = -1;
        continue;
      }
      const float x = (lower[k] - o[k]) / d[k], y = (upper[k] - o[k]) / d[k];
      a = std::max(a, std::min(x, y)), b = std::min(b, std::max(x, y));
    }
    CHECK(inside == doctest::Approx(std::max(b - a, 0.0f)).epsilon(1e-3));
  }
}

}  // namespace

TEST_CASE("grids of Mitsuba 3 have their nodes half a cell inside, and wrap as there") {
  const Point3f points[] = {{.25f, .25f, .25f}, {0, 0, 0}, {-.1f, .5f, .5f}, {1.2f, .5f, .5f}};
  const auto values = [&](VolumeWrap wrap) {
    const GridVolume v(counting({2, 2, 2}), Matrix4{}, VolumeFilter::trilinear, wrap,
                       VolumeNodes::within);
    std::vector<double> result;
    for (const Point3f& p : points) result.push_back(double(v.value(p)));
    return result;
  };
  const auto check = [&](VolumeWrap wrap, const std::vector<double>& expected) {
    const std::vector<double> found = values(wrap);
    for (size_t i = 0; i < expected.size(); ++i)
      CHECK(found[i] == doctest::Approx(expected[i]).epsilon(1e-5));
  };
  check(VolumeWrap::clamp, {1, 1, 4, 5});
  check(VolumeWrap::mirror, {1, 1, 4, 5});
  check(VolumeWrap::repeat, {1, 4.5, 4.7, 4.1});
}

TEST_CASE("grids of 0.x have their outermost nodes on the faces and nothing outside") {
  const GridVolume v(counting({2, 3, 2}), Matrix4{}, VolumeFilter::trilinear, VolumeWrap::clamp,
                     VolumeNodes::on_faces);
  CHECK(v.value({0, 0, 0}) == 1);
  CHECK(v.value({1, 0, 0}) == 2);
  CHECK(v.value({0, .5f, 0}) == 3);
  CHECK(v.value({1, 1, 1}) == 12);
  CHECK(v.value({.5f, .25f, 0}) == doctest::Approx(2.5));
  CHECK(v.value({1.001f, 0, 0}) == 0);
  CHECK(v.value({.5f, -.001f, .5f}) == 0);
}

TEST_CASE(
    "grids of pbrt have their outermost nodes half a cell beyond the faces, nothing outside") {
  const GridVolume v(counting({4, 3, 3}), Matrix4{}, VolumeFilter::trilinear, VolumeWrap::clamp,
                     VolumeNodes::beyond);
  // Two cells along x, one along the others: nodes 1 and 2 of the middle row are 18 and 19.
  CHECK(v.local_value({0.25f, 0.5f, 0.5f}) == doctest::Approx(18));
  CHECK(v.local_value({0.75f, 0.5f, 0.5f}) == doctest::Approx(19));
  CHECK(v.local_value({0, 0.5f, 0.5f}) == doctest::Approx(17.5));
  CHECK(v.local_value({1, 0.5f, 0.5f}) == doctest::Approx(19.5));
  CHECK(v.local_value({-1e-4f, 0.5f, 0.5f}) == 0);
  CHECK(v.local_value({0.5f, 1.0001f, 0.5f}) == 0);
  check_traversal(v);
}

TEST_CASE("lookups without interpolation, in colours, and in another place") {
  const GridVolume nearest(counting({2, 1, 1}), Matrix4{}, VolumeFilter::nearest, VolumeWrap::clamp,
                           VolumeNodes::within);
  CHECK(nearest.value({.49f, .9f, .1f}) == 1);
  CHECK(nearest.value({.51f, .9f, .1f}) == 2);
  const GridVolume color(counting({2, 1, 1}, 3),
                         Matrix4::translate(5, 0, 0) * Matrix4::scale(2, 1, 1),
                         VolumeFilter::trilinear, VolumeWrap::clamp, VolumeNodes::within);
  CHECK(color.color({5, 0, 0}) == Spectrum(1, 2, 3));
  CHECK(color.color({6, 0, 0}).g == doctest::Approx(3.5));
  CHECK(color.value({5, 0, 0}) == doctest::Approx(Spectrum(1, 2, 3).luminance()));
  // Far outside, where single precision has no fractions left.
  CHECK(color.color({1e30f, 0, 0}) == Spectrum(4, 5, 6));
  const GridVolume six(counting({1, 1, 1}, 6), Matrix4{}, VolumeFilter::trilinear,
                       VolumeWrap::clamp, VolumeNodes::within);
  CHECK(six.matrix({.2f, .3f, .4f}) == SymmetricMatrix{1, 2, 3, 4, 5, 6});
}

TEST_CASE("no value in a box is above its maximum, whatever the filter and wrap mode") {
  RandomStream random(3);
  for (const VolumeWrap wrap : {VolumeWrap::clamp, VolumeWrap::repeat, VolumeWrap::mirror})
    for (const VolumeFilter filter : {VolumeFilter::nearest, VolumeFilter::trilinear})
      for (const VolumeNodes nodes :
           {VolumeNodes::within, VolumeNodes::on_faces, VolumeNodes::beyond})
        for (const int channels : {1, 3}) {
          const GridVolume v(noise({7, 5, 4}, channels, 9), Matrix4{}, filter, wrap, nodes);
          for (int i = 0; i < 200; ++i) {
            Point3f lower, upper, p;
            for (int a = 0; a < 3; ++a) {
              const float x = random.next(), y = random.next();
              lower[a] = std::min(x, y), upper[a] = std::max(x, y);
              p[a] = lerp(lower[a], upper[a], random.next());
            }
            CHECK(v.local_color(p).max() <= v.maximum(lower, upper) * 1.0001f);
          }
        }
}

TEST_CASE("a ray meets the cells of a majorant grid in order and without gaps") {
  const auto grid = noise({32, 20, 9}, 1, 4);
  // As it is, and turned: then its box in the world is larger than itself.
  for (const double degrees : {0.0, 40.0}) {
    const GridVolume v(grid, Matrix4::rotate(degrees, 1, 2, 3), VolumeFilter::trilinear,
                       VolumeWrap::clamp, VolumeNodes::within);
    check_traversal(v);
  }
}

TEST_CASE("clouds are where their noise is, and thin out with height") {
  const CloudShape shape{{-1, -1, -1}, {1, 1, 1}, 3, 0.8f, 3};
  const CloudVolume cloud(shape, Spectrum(2, 4, 1), Matrix4::translate(5, 0, 0));
  CHECK(cloud.channels() == 3);
  CHECK(CloudVolume(shape, Spectrum(2), Matrix4{}).channels() == 1);
  RandomStream random(3);
  double low = 0, high = 0, other = 0;
  const CloudVolume smooth({{-1, -1, -1}, {1, 1, 1}, 3, 0, 3}, Spectrum(1), Matrix4{});
  for (int i = 0; i < 20000; ++i) {
    const Point3f p(random.next() * 2 - 1, random.next() * 2 - 1, random.next() * 2 - 1);
    const float d = cloud.density(p);
    CHECK(d >= 0);
    CHECK(d <= 1);
    if (p.y < 0) CHECK(d == 1);
    (p.y < 0.7f ? low : high) += double(d);
    other += std::abs(double(d - smooth.density(p)));
    CHECK(cloud.local_color(p) == Spectrum(2, 4, 1) * d);
  }
  CHECK(high > 10);
  CHECK(low > 5 * high);
  CHECK(other > 20);
  CHECK(cloud.density({0, -0.5f, 1.001f}) == 0);
  CHECK(cloud.maximum({-1, -1, -1}, {0, 0, 0}) == 4);
  CHECK(cloud.maximum({1.1f, 0, 0}, {2, 1, 1}) == 0);
  Point3f lower, upper;
  cloud.world_box(lower, upper);
  CHECK(lower == Point3f(4, -1, -1));
  CHECK(upper == Point3f(6, 1, 1));
}
