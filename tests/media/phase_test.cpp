// Phase functions: directions against densities, densities against one, and against Mitsuba 3.9.1.
#include "media/phase_functions.h"

#include <doctest/doctest.h>

#include "support/show.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;

namespace {

const Point3f kPoint(0.3f, 0.4f, 0.6f);

std::shared_ptr<const VolumeGrid> weights() {
  VolumeGrid grid;
  grid.size = {2, 1, 1};
  grid.values = {0.1f, 0.9f};
  return std::make_shared<VolumeGrid>(grid);
}

MatrixVolume matrix(const SymmetricMatrix& m) {
  return {m, nullptr};
}

/// All of them, with parameters far from the simple ones.
struct Functions {
  Isotropic isotropic;
  HenyeyGreenstein forward{0.7f}, backward{-0.4f}, almost_isotropic{5e-4f};
  Rayleigh rayleigh;
  Tabulated table{std::vector<double>{2, 0.5, 0, 1, 4}};
  Sggx flakes{matrix({0.3f, 0.5f, 0.9f, 0.1f, -0.2f, 0.15f})};
  Sggx fibre{matrix({1, 1, 0.05f, 0, 0, 0})};
  GridVolume weight{weights(), Matrix4{}, VolumeFilter::trilinear, VolumeWrap::clamp,
                    VolumeNodes::within};
  BlendedPhase blend{FloatVolumeSlot{0, &weight}, forward, rayleigh};

  std::vector<std::pair<const char*, const PhaseFunction*>> all() const {
    return {{"isotropic", &isotropic},   {"hg, forward", &forward},
            {"hg, backward", &backward}, {"hg, almost isotropic", &almost_isotropic},
            {"rayleigh", &rayleigh},     {"tabphase", &table},
            {"sggx", &flakes},           {"sggx, fibre", &fibre},
            {"blendphase", &blend}};
  }
};

const Vector3f kDirections[] = {
    {0, 0, 1}, {0, 0, -1}, normalize(Vector3f(0.3f, -0.8f, 0.2f)), {1, 0, 0}};

}  // namespace

TEST_CASE("phase functions send light where their densities say, and all of it somewhere") {
  const Functions functions;
  SquareTest options;
  options.samples = 100000;
  options.sub = 24;  // narrow lobes
  options.level = sidak(0.001, int(std::size(kDirections) * functions.all().size()));
  for (const auto& [name, f] : functions.all())
    for (const Vector3f& wo : kDirections) {
      SHOW(std::string(name));
      CAPTURE(wo.x);
      CAPTURE(wo.z);
      ++options.seed;
      const Chi2Result r = chi2_sphere(
          [&, f = f](float u, Point2f v, Vector3f& wi) {
            const PhaseSample s = f->sample(kPoint, wo, u, v);
            wi = s.wi;
            return s.pdf.value > 0;
          },
          [&, f = f](const Vector3f& wi) { return double(f->eval(kPoint, wo, wi).value); },
          options);
      CHECK_MESSAGE(r.pass, r.message);
    }
}

TEST_CASE("the density of a sampled direction is the one that eval gives") {
  const Functions functions;
  for (const auto& [name, f] : functions.all())
    for (const Vector3f& wo : kDirections)
      for (int i = 0; i < 50; ++i) {
        SHOW(std::string(name));
        const PhaseSample s =
            f->sample(kPoint, wo, (float(i) + 0.5f) / 50,
                      {std::fmod(float(i) * 0.618f, 1.0f), std::fmod(float(i) * 0.414f, 1.0f)});
        CHECK(length(s.wi) == doctest::Approx(1).epsilon(1e-4));
        CHECK(f->eval(kPoint, wo, s.wi).value == doctest::Approx(s.pdf.value).epsilon(2e-3));
      }
}

TEST_CASE("phase functions have Mitsuba's values and orientation") {
  const Vector3f wo(0, 0, 1);  // straight on is −z
  const auto at = [&](const PhaseFunction& f, const Vector3f& wi) {
    return double(f.eval(kPoint, wo, wi).value);
  };
  const HenyeyGreenstein hg(0.5f);
  CHECK(at(hg, {0, 0, 1}) == doctest::Approx(0.0176839));
  CHECK(at(hg, {0, 0, -1}) == doctest::Approx(0.477465));
  CHECK(at(hg, {0.6f, 0, 0.8f}) == doctest::Approx(0.0203339));
  const Rayleigh rayleigh;
  CHECK(at(rayleigh, {1, 0, 0}) == doctest::Approx(0.0596831));
  CHECK(at(rayleigh, {0.6f, 0, 0.8f}) == doctest::Approx(0.0978803));
  const Tabulated table(std::vector<double>{0.5, 1, 2});
  CHECK(at(table, {0, 0, 1}) == doctest::Approx(0.0353678));
  CHECK(at(table, {0, 0, -1}) == doctest::Approx(0.141471));
  CHECK(at(table, {0.6f, 0, 0.8f}) == doctest::Approx(0.0424413));
  const Sggx flakes(matrix({0.3f, 0.5f, 0.9f, 0.1f, 0, 0}));
  CHECK(at(flakes, {0.424264f, 0.707107f, -0.565685f}) == doctest::Approx(0.0797433));
  CHECK(flakes.extinction(kPoint, wo) == doctest::Approx(0.9486833));
}

TEST_CASE("the mean cosine of the deflection is g") {
  for (const float g : {-0.8f, -0.3f, 0.0f, 0.5f, 0.9f}) {
    const HenyeyGreenstein hg(g);
    const Vector3f wo = normalize(Vector3f(1, 2, -1));
    double sum = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
      sum -= double(dot(wo, hg.sample(kPoint, wo, 0, {0.25f, (float(i) + 0.5f) / n}).wi));
    CHECK(sum / n == doctest::Approx(double(g)).epsilon(2e-3));
  }
}

TEST_CASE("flakes turn no more area to the light than their bound says") {
  const Functions functions;
  for (const Sggx* f : {&functions.flakes, &functions.fibre})
    for (const Vector3f& w : kDirections) {
      CHECK(f->extinction(kPoint, w) <= f->max_extinction());
      CHECK(f->extinction(kPoint, w) == doctest::Approx(f->extinction(kPoint, -w)));
    }
  // Empty places of a grid must not make numbers that are none.
  const Sggx empty(matrix({0, 0, 0, 0, 0, 0}));
  CHECK(empty.extinction(kPoint, {0, 0, 1}) == 0);
  CHECK(std::isfinite(empty.eval(kPoint, {0, 0, 1}, {1, 0, 0}).value));
}
