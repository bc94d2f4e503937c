// Paths in groups of pixels have the same mean as paths on their own, and less noise.
#include "integrators/wide_pixel_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/failures.h"
#include "integrators/batch_cases.h"
#include "integrators/path.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kTiles = 4;  ///< per side
constexpr int kSeeds = 12;

PathIntegratorDescription in_groups(int members, const PathLimits& limits = {}) {
  PathIntegratorDescription d{limits};
  d.pixel_group = members;
  return d;
}

Image render_group(const TransportScene& s, const PathIntegratorDescription& d,
                   const RenderRequest& r) {
  PathIntegrator path(d, {});
  return render(*s.scene, path, s.layout, r).image;
}

/// Plastic whose coat reflects more than its base.
const std::string kDark = ggx_plastic(
    "<float name='alpha' value='0.25'/><float name='int_ior' value='2.2'/>"
    "<rgb name='diffuse_reflectance' value='0.3,0.15,0.1'/>");

/// The light in each of the tiles.
std::array<double, kTiles * kTiles> tile_sums(const Image& image) {
  std::array<double, kTiles * kTiles> sums{};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        sums[size_t(y * kTiles / image.height * kTiles + x * kTiles / image.width)] +=
            double(image.data[size_t((y * image.width + x) * image.channel_count() + c)]);
  return sums;
}

/// How often the difference of means is larger than its error: of the same paths, so that most of
/// their noise is in both.
struct Differences {
  double worst = 0;  ///< of a tile, in standard errors
  double mean = 0;   ///< of the image, relative
  double error = 0;  ///< of that
};

Differences compare_means(const TransportScene& s, const PathLimits& limits, int members) {
  constexpr size_t kCells = kTiles * kTiles;
  std::array<double, kCells + 1> sum{}, squares{};
  double light = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    RenderRequest r = batch_request(8, SampleSequence::independent);
    r.seed = uint64_t(seed);
    const auto own = tile_sums(render_group(s, in_groups(1, limits), r));
    const auto grouped = tile_sums(render_group(s, in_groups(members, limits), r));
    double all = 0;
    for (size_t t = 0; t < kCells; ++t) {
      const double d = grouped[t] - own[t];
      sum[t] += d, squares[t] += d * d, all += d, light += own[t];
    }
    sum[kCells] += all, squares[kCells] += all * all;
  }
  const auto error = [&](size_t t) {
    return std::sqrt(std::max(squares[t] - sum[t] * sum[t] / kSeeds, 0.0) * kSeeds / (kSeeds - 1));
  };
  Differences out{0, sum[kCells] / light, error(kCells) / light};
  for (size_t t = 0; t < kCells; ++t)
    if (error(t) > 1e-5 * light) out.worst = std::max(out.worst, std::abs(sum[t]) / error(t));
  return out;
}

}  // namespace

// With these seeds it notices 1 % of the image (usually 0.2 %).
TEST_CASE("paths in groups of pixels have the mean of paths on their own") {
  std::vector<BatchCase> cases = kBatchCases;
  cases.push_back({"shiny and patterned balls in a diffuse room",
                   camera() + room_xml(grey("0.7")) + kLamp +
                       sphere_xml("-0.5,0.2,0.5", "0.5", smooth_plastic("")) +
                       lumpy_xml("0.5,0,0.5", kPatternedMetal) +
                       lumpy_xml("0.1,-0.4,1.2", kPatternedMetal)});
  cases.push_back({"coloured rough plastics of both kinds of facets, light on their backs",
                   camera() + room_xml(kDark) + kLamp + lumpy_xml("-0.5,0.2,0.5", kTinted) +
                       lumpy_xml("0.5,0,0.5", kVarnishedCheckers) +
                       hollow_xml("0.1,-0.4,1.2", "0.4", kPlastic)});
  for (const BatchCase& c : cases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    PathLimits limits;
    limits.max_depth = 6;
    limits.rr_depth = 1;
    const Differences d = compare_means(scene, limits, 16);
    CAPTURE(d.mean);
    CAPTURE(d.error);
    CAPTURE(d.worst);
    CHECK(d.error < 0.0025);
    CHECK(std::abs(d.mean) < 4 * d.error + 1e-4);
    CHECK(d.worst < 7);
  }
}

TEST_CASE("so they have with hidden emitters, strict normals and groups of other sizes") {
  PathLimits limits;
  limits.hide_emitters = limits.strict_normals = true;
  for (const size_t number : {0, 1, 2, 3})
    for (const int members : {3, 64}) {
      CAPTURE(number);
      CAPTURE(members);
      const Differences d = compare_means(kBatchCases[number].scene(), limits, members);
      CAPTURE(d.mean);
      CAPTURE(d.error);
      CHECK(std::abs(d.mean) < 4 * d.error + 1e-4);
      CHECK(d.worst < 7);
    }
}

// What the pixels of a group have from one another may be right in sum but in none of them. The
// figure is 1.05 ± 0.1: half a standard error in every pixel is noticed.
TEST_CASE("each pixel of a group has the mean of its own paths") {
  const TransportScene scene(
      TemporaryDirectory(),
      camera_xml("0,-3.2,1", "0,0,1", 16) + room_xml(kDark) + kLamp +
          sphere_xml("-0.5,0.2,0.5", "0.5",
                     ggx_plastic("<rgb name='diffuse_reflectance' value='0.6,0.5,0.4'/>")) +
          lumpy_xml("0.5,0,0.5", kVarnishedCheckers));
  constexpr int kRuns = 40, kPixels = 16 * 16;
  std::array<double, kPixels> sum{}, squares{};
  double light = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    RenderRequest r = batch_request(64, SampleSequence::independent);
    r.seed = uint64_t(seed);
    const Image own = render_group(scene, in_groups(1), r),
                grouped = render_group(scene, in_groups(16), r);
    const size_t channels = size_t(own.channel_count());
    for (size_t i = 0; i < kPixels; ++i) {
      double d = 0;
      for (size_t k = i * channels; k < i * channels + 3; ++k)
        d += double(grouped.data[k]) - double(own.data[k]), light += double(own.data[k]);
      sum[i] += d, squares[i] += d * d;
    }
  }
  double z2 = 0, error2 = 0;
  for (size_t i = 0; i < kPixels; ++i) {
    const double variance = (squares[i] - sum[i] * sum[i] / kRuns) * kRuns / (kRuns - 1);
    z2 += sum[i] * sum[i] / variance / kPixels, error2 += variance * kPixels / (light * light);
  }
  CHECK(std::sqrt(error2) < 0.005);
  CHECK(z2 < 1.35);
}

TEST_CASE("groups of pixels have less noise where light comes from diffuse bases") {
  const std::string base = "<rgb name='diffuse_reflectance' value='0.7,0.6,0.5'/>";
  std::string walls;
  SUBCASE("walls") {
    walls = grey("0.7");
  }
  SUBCASE("smooth plastics") {
    walls = smooth_plastic(base);
  }
  SUBCASE("rough plastics") {
    walls = ggx_plastic(base);
  }
  const TransportScene scene(camera() + room_xml(walls) + lamp_xml("0.3", "9,8,7"));
  const auto noise = [&](int members) {
    PathLimits limits;
    limits.hide_emitters = true;  // whose edges have more noise than all else
    RenderRequest r = batch_request(4, SampleSequence::independent);
    const Image a = render_group(scene, in_groups(members, limits), r);
    r.seed = 1;
    const Image b = render_group(scene, in_groups(members, limits), r);
    // The median: what coats mirror is as noisy as before.
    std::vector<double> squares;
    for (size_t i = 0; i < a.data.size(); ++i)
      squares.push_back(std::pow(double(a.data[i] - b.data[i]), 2));
    std::nth_element(squares.begin(), squares.begin() + squares.size() / 2, squares.end());
    return squares[squares.size() / 2];
  };
  CAPTURE(noise(16) / noise(1));
  CHECK(noise(16) < 0.75 * noise(1));
}

TEST_CASE("groups of pixels make the same image on any number of threads, in passes and windows") {
  TransportScene scene(coplanar());
  RenderRequest r = batch_request(6, SampleSequence::sobol, 1);
  const PathIntegratorDescription d = in_groups(16);
  const Image one = render_group(scene, d, r);
  for (const int threads : {2, 7}) {
    r.threads = threads;
    CHECK(render_group(scene, d, r).data == one.data);
  }
  r.pass_seconds = 0;
  CHECK(render_group(scene, d, r).data == one.data);
  scene.layout.crop = {5, 11, 23, 37};
  const Image window = render_group(scene, d, r);
  int same = 0;
  const int row = window.width * window.channel_count();
  for (int y = 0; y < window.height; ++y)
    for (int i = 0; i < row; ++i)
      same += window.data[size_t(y * row + i)] ==
              one.data[size_t((y + 11) * one.width * one.channel_count() + 5 * one.channel_count() +
                              i)];
  CHECK(same == window.height * row);
}

TEST_CASE("groups of pixels are refused where paths are traced one by one") {
  const TransportScene scene(camera() + room_xml(grey("0.7")) + lamp_xml("0.3", "9,8,7"));
  PathIntegratorDescription d = in_groups(16);
  d.only_specular = true;
  CHECK_THROWS_AS(render_group(scene, d, batch_request(1, SampleSequence::sobol)), SceneFailure);
  PathLimits none;
  none.max_depth = 0;
  CHECK_THROWS_AS(render_group(scene, in_groups(2, none), batch_request(1, SampleSequence::sobol)),
                  SceneFailure);
}
