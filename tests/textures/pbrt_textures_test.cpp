// Textures that pbrt has: noise, patterns in space, mappings, and what is made of other textures.
#include <doctest/doctest.h>

#include "math/hash.h"
#include "textures/combined_textures.h"
#include "textures/noise.h"
#include "textures/solid_textures.h"

using namespace duet;

namespace {

Surface at(const Point3f& p, const Point2f& uv = {0, 0}) {
  Surface s{};
  s.position = p;
  s.ng = {0, 0, 1};
  s.uv = uv;
  s.shading = Frame({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  s.dp_du = {2, 0, 0};
  s.dp_dv = {0, 0.5f, 1};
  return s;
}

float random_number(uint32_t i) {
  return to_unit_float(mix32(i));
}

/// u + 2 v, in three shades.
class Ramp final : public Texture {
 public:
  Spectrum color(const Surface& s) const override { return Spectrum(1, 0.5f, 0) * value(s); }
  float value(const Surface& s) const override { return s.uv.x + 2 * s.uv.y; }
  Point2f gradient(const Surface&) const override { return {1, 2}; }
  Spectrum average() const override { return Spectrum(1.5f, 0.75f, 0); }
};

/// Derivatives of value() as the texture coordinates change, and the position with them.
Point2f differences(const Texture& texture, const Surface& s) {
  const float h = 2.5e-4f;
  const auto moved = [&](float u, float v) {
    Surface there = s;
    there.uv = {s.uv.x + u, s.uv.y + v};
    there.position = s.position + s.dp_du * u + s.dp_dv * v;
    return texture.value(there);
  };
  return {(moved(h, 0) - moved(-h, 0)) / (2 * h), (moved(0, h) - moved(0, -h)) / (2 * h)};
}

void check_gradient(const Texture& texture, const Surface& s) {
  const Point2f expected = differences(texture, s), g = texture.gradient(s);
  CHECK(g.x == doctest::Approx(expected.x).epsilon(0.02));
  CHECK(g.y == doctest::Approx(expected.y).epsilon(0.02));
}

Matrix4 rows(const std::array<double, 4>& x, const std::array<double, 4>& y,
             const std::array<double, 4>& z) {
  Matrix4 m;
  m[0] = x, m[1] = y, m[2] = z;
  return m;
}

}  // namespace

TEST_CASE("noise is Perlin's") {
  // The figure with which implementations of the paper are compared.
  CHECK(perlin_noise({3.14f, 42, 7}) == doctest::Approx(0.136919958784).epsilon(1e-5));
  float least = 1, most = -1;
  for (uint32_t i = 0; i < 10000; ++i) {
    const Point3f p(64 * random_number(3 * i) - 32, 64 * random_number(3 * i + 1) - 32,
                    64 * random_number(3 * i + 2) - 32);
    const float n = perlin_noise(p);
    least = std::min(least, n), most = std::max(most, n);
    CHECK(perlin_noise({p.x + 256, p.y - 512, p.z}) == doctest::Approx(n).epsilon(1e-3));
    CHECK(perlin_noise({std::floor(p.x), std::floor(p.y), std::floor(p.z)}) == 0);
    // It has no steps at the faces of cells.
    const float face = std::floor(p.x);
    CHECK(std::abs(perlin_noise({face - 1e-4f, p.y, p.z}) - perlin_noise({face, p.y, p.z})) <
          1e-3f);
  }
  CHECK(least > -1);
  CHECK(least < -0.6f);
  CHECK(most < 1);
  CHECK(most > 0.6f);
  CHECK(std::isfinite(perlin_noise({1e30f, -1e30f, 3e9f})));
}

TEST_CASE("octaves are summed without exception") {
  const Point3f p(0.3f, -1.7f, 2.4f);
  const auto noise = [&](float f) { return perlin_noise({f * p.x, f * p.y, f * p.z}); };
  CHECK(fractal_noise(p, 0.6f, 0) == 0);
  CHECK(fractal_noise(p, 0.6f, 1) == noise(1));
  CHECK(fractal_noise(p, 0.6f, 3) ==
        doctest::Approx(noise(1) + 0.6f * noise(1.99f) + 0.36f * noise(1.99f * 1.99f)));
  CHECK(turbulence(p, 0.6f, 2) ==
        doctest::Approx(std::abs(noise(1)) + 0.6f * std::abs(noise(1.99f)) + 0.36f * 0.2f));
}

TEST_CASE("noise textures are looked up in the space of the texture") {
  const SpaceMap twice(Matrix4::scale(2, 2, 2));
  const Point3f p(0.3f, 0.8f, -0.4f), q(0.6f, 1.6f, -0.8f);
  NoiseOptions o{.octaves = 3, .roughness = 0.7f};
  CHECK(NoiseTexture(o, twice).value(at(p)) == doctest::Approx(fractal_noise(q, 0.7f, 3)));
  o.kind = NoiseKind::wrinkled;
  CHECK(NoiseTexture(o, twice).value(at(p)) == doctest::Approx(turbulence(q, 0.7f, 3)));
  o.kind = NoiseKind::windy;
  CHECK(NoiseTexture(o, twice).value(at(p)) ==
        doctest::Approx(std::abs(fractal_noise({0.06f, 0.16f, -0.08f}, 0.5f, 3)) *
                        fractal_noise(q, 0.5f, 6)));
  for (const NoiseKind kind : {NoiseKind::fbm, NoiseKind::wrinkled, NoiseKind::windy}) {
    o.kind = kind;
    const NoiseTexture texture(o, twice);
    check_gradient(texture, at(p));
    CHECK(!texture.needs_uv());
    double sum = 0;
    for (uint32_t i = 0; i < 40000; ++i)
      sum += double(texture.value(at({128 * random_number(7 * i), 128 * random_number(7 * i + 1),
                                      128 * random_number(7 * i + 2)}))) /
             40000;
    CHECK(double(texture.average().g) == doctest::Approx(sum).epsilon(0.03).scale(1));
  }
}

TEST_CASE("marble has the colours of its spline") {
  NoiseOptions o{.kind = NoiseKind::marble, .scale = 2, .variation = 0};
  const NoiseTexture texture(o, SpaceMap());
  // Without variation it depends on the sine of y alone, which is 1 at the last colour.
  const auto y_of = [](float sine) { return std::asin(sine) / 2; };
  const Spectrum first = texture.color(at({0, y_of(-1), 0}));
  CHECK(first.r == doctest::Approx(1.5f * 0.58f));
  CHECK(first.b == doctest::Approx(1.5f * 0.6f));
  CHECK(texture.color(at({0, y_of(1), 0})).r == doctest::Approx(1.5f * 0.58f));
  // At the middle of the last piece: Bernstein's polynomials of its four colours.
  const Spectrum c = texture.color(at({5, y_of(2 * 5.5f / 6 - 1), -3}));
  CHECK(c.r == doctest::Approx(1.5f * (0.58f + 3 * 0.58f + 3 * 0.2f + 0.58f) / 8).epsilon(1e-4));
  CHECK(c.b == doctest::Approx(1.5f * (0.6f + 3 * 0.6f + 3 * 0.33f + 0.6f) / 8).epsilon(1e-4));
  o.variation = 1;
  CHECK(NoiseTexture(o, SpaceMap()).color(at({0.3f, 0.2f, 0.7f})) !=
        texture.color(at({0.3f, 0.2f, 0.7f})));
}

TEST_CASE("mappings of space") {
  const auto on = [](SpaceMapKind kind, const Point3f& p) { return texture_coordinates(kind, p); };
  using enum SpaceMapKind;
  CHECK(on(spherical, {0, 0, 3}).x == doctest::Approx(0));
  CHECK(on(spherical, {0, 0, -3}).x == doctest::Approx(1));
  CHECK(on(spherical, {2, 0, 0}).x == doctest::Approx(0.5));
  CHECK(on(spherical, {2, 0, 0}).y == doctest::Approx(0));
  CHECK(on(spherical, {0, 1, 0}).y == doctest::Approx(0.25));
  CHECK(on(spherical, {0, -1, 0}).y == doctest::Approx(0.75));
  CHECK(on(cylindrical, {1, 0, 7}).x == doctest::Approx(0.5));
  CHECK(on(cylindrical, {0, 1, 7}).x == doctest::Approx(0.75));
  CHECK(on(cylindrical, {0, 1, 7}).y == 7);
  CHECK(std::isfinite(on(spherical, {0, 0, 0}).x));
  // Two vectors and two shifts make planar coordinates, though they have no inverse.
  const SpaceMap plane(rows({0.6, 0, 0, 0.1}, {0, 0.2, 0.6, 0.3}, {0, 0, 0, 0}));
  const Ramp ramp;
  const MappedTexture mapped(ramp, planar, plane);
  const Surface s = at({1, 2, 3}, {9, 9});
  CHECK(mapped.value(s) == doctest::Approx(0.7 + 2 * (0.4 + 1.8 + 0.3)));
  CHECK(mapped.color(s).g == doctest::Approx(mapped.value(s) / 2));
  CHECK(mapped.gradient(s).x == doctest::Approx(1.2).epsilon(0.01));
  CHECK(mapped.gradient(s).y == doctest::Approx(2 * (0.1 + 0.6)).epsilon(0.01));
  CHECK(!mapped.needs_uv());
}

TEST_CASE("a chequerboard of cubes") {
  const SolidCheckerboard board({Spectrum(1, 0, 0)}, {Spectrum(0, 1, 0)}, SpaceMap());
  CHECK(board.color(at({0.5f, 0.5f, 0.5f})) == Spectrum(1, 0, 0));
  CHECK(board.color(at({1.5f, 0.5f, 0.5f})) == Spectrum(0, 1, 0));
  CHECK(board.color(at({-0.5f, 0.5f, 0.5f})) == Spectrum(0, 1, 0));
  CHECK(board.color(at({-0.5f, -0.5f, 0.5f})) == Spectrum(1, 0, 0));
  CHECK(board.color(at({-0.5f, -0.5f, -0.5f})) == Spectrum(0, 1, 0));
  CHECK(board.average() == Spectrum(0.5f, 0.5f, 0));
}

TEST_CASE("sums, products and functions of textures") {
  const Ramp ramp;
  const Surface s = at({0, 0, 0}, {0.2f, 0.1f});  // 0.4
  const ColorSlot textured{{}, &ramp}, grey{Spectrum(0.25f)};
  const MixTexture mix(grey, textured, {0, &ramp});
  CHECK(mix.value(s) == doctest::Approx(0.6 * 0.25 + 0.4 * 0.4));
  CHECK(mix.color(s).g == doctest::Approx(0.6 * 0.25 + 0.4 * 0.2));
  check_gradient(mix, s);
  const ProductTexture product(textured, textured);
  CHECK(product.value(s) == doctest::Approx(0.16));
  CHECK(product.color(s).g == doctest::Approx(0.04));
  check_gradient(product, s);
  const FunctionTexture inverse(ramp, TextureFunction::inverse);
  CHECK(inverse.value(s) == doctest::Approx(0.6));
  CHECK(inverse.value(at({}, {2, 2})) == 0);
  check_gradient(inverse, s);
  const FunctionTexture root(ramp, TextureFunction::root);
  CHECK(root.value(s) == doctest::Approx(std::sqrt(0.4)));
  CHECK(root.value(at({}, {-1, 0})) == 0);
  check_gradient(root, s);
  // What such a metal reflects along its normal is r again.
  for (const float r : {0.1f, 0.5f, 0.9f}) {
    const float k = apply(TextureFunction::metal_k, r);
    CHECK(k * k / (4 + k * k) == doctest::Approx(r));
  }
  CHECK(std::isfinite(apply(TextureFunction::metal_k, 1)));
  CHECK(apply(TextureFunction::positive, 0.01f) == 1);
  CHECK(apply(TextureFunction::positive, 0) == 0);
  // pbrt-v3: one at one, and the same for all roughnesses below a thousandth.
  CHECK(apply(TextureFunction::v3_roughness, 1) == doctest::Approx(1.62142));
  CHECK(apply(TextureFunction::v3_roughness, 0.1f) ==
        doctest::Approx(
            1.62142 +
            -2.302585 * (0.819955 +
                         -2.302585 * (0.1734 + -2.302585 * (0.0171201 + -2.302585 * 0.000640711))))
            .epsilon(1e-4));
  CHECK(apply(TextureFunction::v3_roughness, 0) == apply(TextureFunction::v3_roughness, 1e-4f));
  Surface tilted = s;
  tilted.ng = Normal3f(0.6f, 0, -0.8f);
  const DirectionMixTexture by_direction({Spectrum(1)}, {Spectrum(0)}, {0, 0, 1});
  CHECK(by_direction.value(s) == doctest::Approx(1));
  CHECK(by_direction.value(tilted) == doctest::Approx(0.8));
  // As in pbrt, normals of vertices and bumps do not count.
  Surface smooth = s;
  smooth.shading = Frame(Normal3f(0.6f, 0, 0.8f));
  CHECK(by_direction.value(smooth) == doctest::Approx(1));
}

TEST_CASE("colours between four corners") {
  const BilerpTexture texture(Spectrum(0), Spectrum(1, 0, 0), Spectrum(0, 1, 0), Spectrum(0, 0, 1),
                              UvTransform{}, false);
  CHECK(texture.color(at({}, {0, 1})) == Spectrum(1, 0, 0));
  CHECK(texture.color(at({}, {1, 0})) == Spectrum(0, 1, 0));
  CHECK(texture.color(at({}, {1, 1})) == Spectrum(0, 0, 1));
  CHECK(texture.color(at({}, {0.5f, 0.25f})).g == doctest::Approx(0.375));
  UvTransform turned;
  turned.m = {{{0, 2, 0.1}, {-1, 0, 0}}};
  check_gradient(
      BilerpTexture(Spectrum(0), Spectrum(1), Spectrum(0.2f), Spectrum(0.7f), turned, false),
      at({}, {0.3f, 0.4f}));
  const BilerpTexture repeats(Spectrum(0), Spectrum(1, 0, 0), Spectrum(0, 1, 0), Spectrum(0, 0, 1),
                              UvTransform{}, true);
  CHECK(repeats.color(at({}, {3.25f, -0.5f})) == texture.color(at({}, {0.25f, 0.5f})));
  CHECK(texture.color(at({}, {3.25f, -0.5f})) != texture.color(at({}, {0.25f, 0.5f})));
}

TEST_CASE("dots lie in two of five squares and keep to them") {
  const DotsTexture dots({Spectrum(1)}, {Spectrum(0)}, UvTransform{});
  double covered = 0;
  int squares = 0;
  for (int x = -20; x < 20; ++x)
    for (int y = -20; y < 20; ++y) {
      int hits = 0;
      for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j) {
          const Point2f uv{float(x) + (float(i) - 9.5f) / 20, float(y) + (float(j) - 9.5f) / 20};
          const float value = dots.value(at({}, uv));
          CHECK((value == 0 || value == 1));
          hits += value == 1;
        }
      // A whole dot or none: 400 π 0.35² points.
      CHECK((hits == 0 || std::abs(hits - 154) < 8));
      squares += hits > 0;
      covered += hits;
    }
  CHECK(squares > 600);
  CHECK(squares < 680);
  CHECK(double(dots.average().g) == doctest::Approx(covered / (1600 * 400)).epsilon(0.05));
}
