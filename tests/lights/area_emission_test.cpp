// Rays that start at surfaces that emit.
#include <doctest/doctest.h>

#include "math/sampler.h"
#include "math/warp.h"
#include "support/flux.h"
#include "support/lamp.h"
#include "support/statistics.h"
#include "textures/bitmap.h"

using namespace duet;
using test::analytic, test::fan, test::Lamp, test::mesh, test::Probe;

namespace {

const ColorSlot kAreaRadiance{{1, 2, 3}};
const Matrix4 kTurn = Matrix4::rotate(35, 3, 1, 2);
const Matrix4 kSkew = kTurn * Matrix4::scale(1.3, 0.6, 0.9) * Matrix4::rotate(25, 1, 1, 0);

/// A dim image with a brighter spot in another colour.
const Bitmap& lamp_picture() {
  static const Bitmap image = [] {
    std::vector<float> pixels(size_t(16) * 16 * 3, 0.3f);
    for (int y = 4; y < 8; ++y)
      for (int x = 2; x < 6; ++x) {
        const size_t i = size_t(y * 16 + x) * 3;
        pixels[i] = 2, pixels[i + 1] = 6, pixels[i + 2] = 4;
      }
    return Bitmap(std::make_shared<BitmapPixels>(16, 16, 3, pixels), TextureFilter::bilinear,
                  WrapMode::repeat, WrapMode::repeat, {});
  }();
  return image;
}

bool close(float a, float b, float tolerance) {
  return std::abs(a - b) <= tolerance * std::abs(b);
}

/// That whatever can be asked about an emitted ray is answered alike, at its start and where it
/// comes to; and the same of light samples.
void check_answers(const Lamp& lamp, float reach, bool concave = false) {
  const AreaLight& light = *lamp.light;
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  int checked = 0, wrong = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    const auto e = light.sample_emission(position, direction);
    const float t = reach * (0.1f + 0.9f * sampler.next_1d());
    if (!e) continue;
    const Vector3f& w = e->ray.direction;
    CHECK(std::abs(length(w) - 1) < 1e-5f);
    CHECK(e->ray.tmax == INFINITY);
    CHECK(dot(e->point.ng, w) > 0);
    if (!concave) CHECK_FALSE(lamp.accel->occluded(e->ray));
    const Point3f at = e->ray.origin + w * t;
    float d2 = 0;
    const auto s = lamp.look(at, -w, d2);
    if (!s || !close(std::sqrt(d2), t, 1e-3f)) continue;  // the rim, or another part of the shape
    ++checked;
    bool right = close(light.emission_density(*s, w), e->density, 1e-3f);
    right &= close(light.direct_density(*e, at), light.pdf_direct(at, *s, -w, d2).value, 5e-3f);
    const Spectrum emitted = light.emitted(*s, w), found = e->weight * e->density;
    for (int k = 0; k < 3; ++k) right &= close(found[k], emitted[k], 0.02f);
    wrong += !right;
    CHECK(light.emission_density(*s, -w) == 0);
    // A light sample from the same point, which need not find the same part of the light.
    const auto sample = light.sample_direct(at, sampler.next_2d());
    if (!sample) continue;
    const auto hit = lamp.look(at, sample->wi, d2);
    if (!hit || light.emitted(*hit, -sample->wi).is_black()) continue;
    wrong += !close(sample->emission, light.emission_density(*hit, -sample->wi), 2e-3f);
  }
  CHECK(checked > n / 2);
  // Points on the very edge of two cells, and grazing rays.
  CHECK_MESSAGE(wrong <= checked / 100, wrong, " of ", checked);
}

/// That one over the density is the measure of all that there is: area times projected solid angle.
void check_norm(const Lamp& lamp) {
  Sampler sampler(SampleSequence::independent, 4, 0, 0);
  Moments measure;
  for (int i = 0; i < 20000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    const auto e = lamp.light->sample_emission(position, direction);
    measure.add(e ? 1 / double(e->density) : 0.0);
  }
  const double expected = 3.14159265358979 * lamp.light->area();
  CHECK_MESSAGE(std::abs(measure.mean() - expected) < 4 * measure.error() + 1e-4 * expected,
                measure.mean(), " and ", expected);
}

void check_all(const Lamp& lamp, const std::string& name, const std::vector<Probe>& probes) {
  INFO(name);
  for (const Probe& p : probes) test::check_flux(*lamp.light, p, name);
  check_answers(lamp, 0.8f);
  check_norm(lamp);
}

/// A light that is seen from its inside.
void check_inside(const Lamp& lamp, const std::string& name, const Probe& probe) {
  INFO(name);
  test::check_flux(*lamp.light, probe, name);
  check_answers(lamp, 0.2f, true);
  check_norm(lamp);
}

}  // namespace

TEST_CASE("area lights emit the light that points find") {
  const Probe above{{0.3f, -0.2f, 1.7f}, {0.1f, 0.3f, -1}, 0.8f};
  const Probe aside{{-1.6f, 1.1f, 0.9f}, {1, -0.4f, -0.6f}, 1};
  const Probe ahead{{0.8f, 1.2f, 1.8f}, {-0.4f, -0.6f, -1}, 1};
  check_all(Lamp(mesh(fan(), kTurn), kAreaRadiance), "triangles", {above, ahead});
  check_all(Lamp(mesh(make_rectangle(), kSkew), kAreaRadiance), "parallelogram", {above, ahead});
  check_all(Lamp(mesh(make_cube(), kSkew), kAreaRadiance), "box",
            {{{1.9f, 1.2f, 1.6f}, {-1, -0.6f, -0.8f}, 1}, {{-2.5f, 0, 0}, {1, 0, 0}, 1}});
  check_all(Lamp(analytic(ShapeKind::sphere, kTurn), kAreaRadiance), "sphere", {above, aside});
  check_all(
      Lamp(analytic(ShapeKind::sphere, kTurn * Matrix4::scale(-1, 1, 1), true), kAreaRadiance),
      "sphere turned and flipped", {above});
  check_all(Lamp(analytic(ShapeKind::sphere, kSkew), kAreaRadiance), "ellipsoid", {above, aside});
  check_all(Lamp(analytic(ShapeKind::disk, kSkew), kAreaRadiance), "disk", {above, ahead});
  check_all(Lamp(analytic(ShapeKind::cylinder, kSkew), kAreaRadiance), "cylinder", {above, aside});
}

TEST_CASE("area lights emit inwards") {
  const Probe within{{0.2f, -0.1f, 0.1f}, {0.3f, 1, -0.4f}, 0.3f};
  check_inside(Lamp(analytic(ShapeKind::sphere, kTurn, true), kAreaRadiance), "sphere", within);
  check_inside(Lamp(analytic(ShapeKind::sphere, kSkew, true), kAreaRadiance), "ellipsoid", within);
  check_inside(Lamp(analytic(ShapeKind::cylinder, kTurn, true), kAreaRadiance), "cylinder",
               {{0.2f, 0.1f, 0.4f}, {1, 0.2f, 0.3f}, 0.3f});
}

TEST_CASE("textured area lights emit what they show") {
  const ColorSlot slot{{}, &lamp_picture()};
  const Probe above{{0.3f, 0.4f, 1.7f}, {0.1f, -0.3f, -1}, 0.9f};
  check_all(Lamp(mesh(make_rectangle(), kTurn), slot), "rectangle", {above});
  check_all(Lamp(mesh(make_cube(), kTurn), slot), "box",
            {{{1.9f, 1.2f, 1.6f}, {-1, -0.6f, -0.8f}, 1}});
  check_all(Lamp(analytic(ShapeKind::sphere, Matrix4{}), slot), "sphere", {above});
  check_all(Lamp(analytic(ShapeKind::disk, kSkew), slot), "disk", {above});
}

TEST_CASE("emitted rays leave on the side of the shading normal") {
  TriangleMesh m = fan();
  m.normals.assign(5, {0, 0, -1});
  const Lamp reversed(mesh(m, Matrix4{}), kAreaRadiance);
  check_answers(reversed, 0.8f);
  test::check_flux(*reversed.light, {{0.4f, 0.3f, -1.3f}, {0, 0, 1}, 0.8f}, "reversed normals");
  // Normals that lean over so far that grazing directions are on the wrong side.
  m.normals.assign(5, normalize(Normal3f(1, 0, 0.3f)));
  const Lamp leaning(mesh(m, Matrix4{}), kAreaRadiance);
  check_answers(leaning, 0.8f);
  test::check_flux(*leaning.light, {{1.9f, 0.3f, 0.9f}, {-1, 0, -0.5f}, 0.8f}, "leaning normals");
  int empty = 0;
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    const auto e = leaning.light->sample_emission(position, direction);
    empty += !e;
    if (e) CHECK(dot(e->ray.direction, Vector3f(1, 0, 0.3f)) > 0);
    Surface s;
    s.ng = {0, 0, 1};
    s.shading = Frame(normalize(Normal3f(1, 0, 0.3f)));
    s.primitive = 0, s.barycentric = {0.3f, 0.3f};
    const Vector3f w = square_to_cosine_hemisphere(direction);
    CHECK((leaning.light->emission_density(s, w) > 0) == (dot(w, Vector3f(1, 0, 0.3f)) > 0));
  }
  CHECK(empty > 200);
}

TEST_CASE("emitted rays leave on the side of the geometric normal, if that is asked for") {
  TriangleMesh m = fan();
  m.normals.assign(5, normalize(Normal3f(1, 0, 0.3f)));
  const Lamp lamp(mesh(m, Matrix4{}), kAreaRadiance, EmittingSide::geometric);
  check_answers(lamp, 0.8f);
  check_norm(lamp);
  for (const Probe& probe : {Probe{{1.9f, 0.3f, 0.9f}, {-1, 0, -0.5f}, 0.8f},
                             {{-1.9f, 0.3f, 0.9f}, {1, 0, -0.5f}, 0.8f}})
    test::check_flux(*lamp.light, probe, "leaning normals that do not matter");
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d();
    CHECK(lamp.light->sample_emission(position, sampler.next_2d()));
  }
}

TEST_CASE("emitted directions follow the cosine with the geometric normal") {
  for (const ShapeKind kind : {ShapeKind::mesh, ShapeKind::disk}) {
    const Lamp lamp(kind == ShapeKind::mesh ? mesh(make_rectangle(), kSkew) : analytic(kind, kSkew),
                    kAreaRadiance);
    const Normal3f n = lamp.light->sample_emission({0.5f, 0.5f}, {0.5f, 0.5f})->point.ng;
    const auto result = test::chi2_sphere(
        [&](float u, Point2f v, Vector3f& d) {
          const auto e = lamp.light->sample_emission({u, 0.4f}, v);
          if (e) d = e->ray.direction;
          return e.has_value();
        },
        [&](const Vector3f& d) { return double(std::max(dot(n, d), 0.0f) * kInvPi); },
        {.nx = 24, .ny = 16, .sub = 16, .samples = 100000});
    CHECK_MESSAGE(result.pass, result.message);
  }
}

TEST_CASE("black surfaces emit no rays") {
  const Lamp lamp(mesh(fan(), kTurn), ColorSlot{Spectrum(0)});
  CHECK_FALSE(lamp.light->sample_emission({0.3f, 0.4f}, {0.6f, 0.2f}));
}

TEST_CASE("rays are emitted alike at all scales") {
  for (const double scale : {1e-3, 1.0, 1e6}) {
    const Matrix4 place = Matrix4::scale(scale, scale, scale);
    for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::disk, ShapeKind::cylinder}) {
      const Lamp lamp(analytic(kind, place), kAreaRadiance);
      check_answers(lamp, float(scale));
      check_norm(lamp);
    }
    const Lamp lamp(mesh(make_rectangle(), place), kAreaRadiance);
    check_answers(lamp, float(scale));
    check_norm(lamp);
  }
}
