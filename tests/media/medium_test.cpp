// Distances and transmittances against the Beer–Lambert law.
#include <doctest/doctest.h>

#include "media/heterogeneous.h"
#include "media/homogeneous.h"
#include "media/phase_functions.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;

namespace {

const Isotropic kEvenPhase;
constexpr int kSamples = 40000;

/// Along x the grid falls from `first` to `last` linearly between the outermost nodes.
std::shared_ptr<const VolumeGrid> ramp(const Spectrum& first, const Spectrum& last, int channels) {
  VolumeGrid grid;
  grid.size = {24, 2, 2};
  grid.channels = channels;
  for (int yz = 0; yz < 4; ++yz)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < channels; ++c)
        grid.values.push_back(lerp(first[c], last[c], float(x) / 23));
  return std::make_shared<VolumeGrid>(grid);
}

/// What sub-paths find in expectation, whichever channel decides: the share of each channel that
/// gets through, and the light that is scattered where it is not absorbed.
void check_subpath(const Medium& medium, const Ray& ray, const Spectrum& transmittance,
                   const Spectrum& albedo) {
  Moments through[3], scattered[3], shadow[3];
  RandomStream random(17);
  for (int i = 0; i < kSamples; ++i) {
    SpectralWeights w, s;
    w.channel = s.channel = i % 3;
    const float t = medium.sample_distance(ray, random.next(), random, w);
    medium.transmit(ray, random, s);
    CHECK(t >= 0);
    const Spectrum value = w.mean_over_channels();
    for (int c = 0; c < 3; ++c) {
      through[c].add(t < ray.tmax ? 0 : double(value[c]));
      scattered[c].add(t < ray.tmax ? double(value[c]) : 0);
      shadow[c].add(double(s.value[c]));
    }
  }
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    const double t = double(transmittance[c]);
    const double s = double(albedo[c]) * (1 - t);
    // Beyond five standard errors; none where the value is exact.
    CHECK(std::abs(through[c].mean() - t) < 5 * through[c].error() + 1e-5);
    CHECK(std::abs(scattered[c].mean() - s) < 5 * scattered[c].error() + 1e-5);
    CHECK(std::abs(shadow[c].mean() - t) < 5 * shadow[c].error() + 1e-5);
    // Estimates that prove something.
    CHECK(through[c].error() < 0.02);
    CHECK(scattered[c].error() < 0.02);
    CHECK(shadow[c].error() < 0.02);
  }
}

/// The densities are those of sub-paths and light samples: what both find must not depend on how
/// the two are weighed, so that weights sum to one.
void check_weights(const Medium& medium, const Ray& ray, const Spectrum& transmittance) {
  for (const float light_pdf : {0.2f, 3.0f}) {
    Moments both[3];
    RandomStream random(23);
    for (int i = 0; i < kSamples; ++i) {
      SpectralWeights w, s;
      w.channel = s.channel = i % 3;
      Spectrum found;
      if (medium.sample_distance(ray, random.next(), random, w) == INFINITY)
        found += w.value * (1 / (w.pdf + w.light * light_pdf).mean());
      medium.transmit(ray, random, s);
      if (!s.value.is_black()) found += s.value * (1 / (s.pdf * (1 / light_pdf) + s.light).mean());
      for (int c = 0; c < 3; ++c) both[c].add(double(found[c]));
    }
    for (int c = 0; c < 3; ++c) {
      CAPTURE(c);
      CAPTURE(light_pdf);
      CHECK(std::abs(both[c].mean() - double(transmittance[c])) < 5 * both[c].error() + 1e-5);
      CHECK(both[c].error() < 0.01);
    }
  }
}

Spectrum exp_minus(const Spectrum& depth) {
  return {std::exp(-depth.r), std::exp(-depth.g), std::exp(-depth.b)};
}

}  // namespace

TEST_CASE("light gets as far in a homogeneous medium as its extinction allows") {
  const Spectrum sigma(0.5f, 1.5f, 0), albedo(0.9f, 0.3f, 0.5f);
  const HomogeneousMedium medium(sigma, {albedo}, kEvenPhase);
  const Ray ray{{1, 2, 3}, {0, 0, 1}, 1.2f};
  check_subpath(medium, ray, exp_minus(sigma * 1.2f), albedo);
  check_weights(medium, ray, exp_minus(sigma * 1.2f));
  // Endless rays end in the medium, except in channels without extinction.
  SpectralWeights w;
  RandomStream random(1);
  const Ray endless{{0, 0, 0}, {1, 0, 0}, INFINITY};
  CHECK(medium.sample_distance(endless, 0.999f, random, w) < INFINITY);
  medium.transmit(endless, random, w);
  CHECK(w.value.r == 0);
}

TEST_CASE("light gets as far in a grid as the integral over its values allows") {
  const Spectrum albedo(0.9f, 0.3f, 0.5f);
  const Matrix4 placed = Matrix4::translate(-1, 0, 0) * Matrix4::scale(4, 1, 1);
  for (const VolumeNodes nodes : {VolumeNodes::within, VolumeNodes::on_faces}) {
    // Half a cell at each end is flat where the nodes lie inside: the mean stays the same.
    const GridVolume grey(ramp(Spectrum(0.4f), Spectrum(0.1f), 1), placed, VolumeFilter::trilinear,
                          VolumeWrap::clamp, nodes);
    const Ray ray{{-3, .5f, .5f}, {1, 0, 0}, 10};
    const HeterogeneousMedium plain(grey, 2, {albedo}, kEvenPhase);
    check_subpath(plain, ray, exp_minus(Spectrum(4 * 2 * 0.25f)), albedo);
    check_weights(plain, ray, exp_minus(Spectrum(4 * 2 * 0.25f)));
    const GridVolume color(ramp({0.4f, 0, 0.2f}, {0, 0.2f, 0.2f}, 3), placed,
                           VolumeFilter::trilinear, VolumeWrap::clamp, nodes);
    const HeterogeneousMedium coloured(color, 2, {albedo}, kEvenPhase);
    check_subpath(coloured, ray, exp_minus(Spectrum(0.2f, 0.1f, 0.2f) * 8), albedo);
    check_weights(coloured, ray, exp_minus(Spectrum(0.2f, 0.1f, 0.2f) * 8));
  }
}

TEST_CASE("a sub-path that begins and ends within a grid") {
  const GridVolume v(ramp(Spectrum(1), Spectrum(1), 1), Matrix4{}, VolumeFilter::trilinear,
                     VolumeWrap::clamp, VolumeNodes::within);
  const HeterogeneousMedium medium(v, 3, {Spectrum(1)}, kEvenPhase);
  check_subpath(medium, {{.25f, .5f, .5f}, {1, 0, 0}, .5f}, exp_minus(Spectrum(1.5f)), Spectrum(1));
  check_subpath(medium, {{.25f, .5f, .5f}, {0, 1, 0}, INFINITY}, exp_minus(Spectrum(1.5f)),
                Spectrum(1));
  // Beside the grid there is nothing.
  check_subpath(medium, {{2, .5f, .5f}, {1, 0, 0}, INFINITY}, Spectrum(1), Spectrum(1));
}

TEST_CASE("flakes seen edge-on hide less than flakes seen from the front") {
  const Sggx flakes({{0.04f, 0.04f, 1, 0, 0, 0}, nullptr});
  const HomogeneousMedium even(Spectrum(2), {Spectrum(0.5f)}, flakes);
  check_subpath(even, {{0, 0, 0}, {0, 0, 1}, 0.7f}, exp_minus(Spectrum(1.4f)), Spectrum(0.5f));
  check_subpath(even, {{0, 0, 0}, {1, 0, 0}, 0.7f}, exp_minus(Spectrum(1.4f * 0.2f)),
                Spectrum(0.5f));
  const GridVolume v(ramp(Spectrum(1), Spectrum(1), 1), Matrix4{}, VolumeFilter::trilinear,
                     VolumeWrap::clamp, VolumeNodes::within);
  const HeterogeneousMedium grid(v, 2, {Spectrum(0.5f)}, flakes);
  check_subpath(grid, {{-1, .5f, .5f}, {1, 0, 0}, 9}, exp_minus(Spectrum(2 * 0.2f)),
                Spectrum(0.5f));
}
