#include "integrators/group_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace duet::test {

namespace {

constexpr int kTiles = 4;  ///< per side
constexpr size_t kCells = kTiles * kTiles;

RenderRequest independent(int samples, int seed) {
  RenderRequest r = batch_request(samples, SampleSequence::independent);
  r.seed = uint64_t(seed);
  return r;
}

/// The light in each of the tiles.
std::array<double, kCells> tile_sums(const Image& image) {
  std::array<double, kCells> sums{};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        sums[size_t(y * kTiles / image.height * kTiles + x * kTiles / image.width)] +=
            double(image.data[size_t((y * image.width + x) * image.channel_count() + c)]);
  return sums;
}

/// Of the sum of `n` numbers, from their sum and that of their squares.
double variance_of_sum(double sum, double squares, int n) {
  return std::max(squares - sum * sum / n, 0.0) * n / (n - 1);
}

}  // namespace

Differences compare_means(const RenderGroup& render, int members) {
  constexpr int kSeeds = 12;
  std::array<double, kCells + 1> sum{}, squares{};
  double light = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const RenderRequest r = independent(8, seed);
    const auto own = tile_sums(render(1, r)), grouped = tile_sums(render(members, r));
    double all = 0;
    for (size_t t = 0; t < kCells; ++t) {
      const double d = grouped[t] - own[t];
      sum[t] += d, squares[t] += d * d, all += d, light += own[t];
    }
    sum[kCells] += all, squares[kCells] += all * all;
  }
  const auto error = [&](size_t t) {
    return std::sqrt(variance_of_sum(sum[t], squares[t], kSeeds));
  };
  Differences out{0, sum[kCells] / light, error(kCells) / light};
  for (size_t t = 0; t < kCells; ++t)
    if (error(t) > 1e-5 * light) out.worst = std::max(out.worst, std::abs(sum[t]) / error(t));
  return out;
}

PixelDifferences compare_pixels(const RenderGroup& render, int members, int samples) {
  constexpr int kRuns = 40;
  std::vector<double> sum, squares;
  double light = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    const RenderRequest r = independent(samples, seed);
    const Image own = render(1, r), grouped = render(members, r);
    const auto channels = size_t(own.channel_count());
    sum.resize(own.data.size() / channels), squares.resize(sum.size());
    for (size_t i = 0; i < sum.size(); ++i) {
      double d = 0;
      for (size_t k = i * channels; k < i * channels + 3; ++k)
        d += double(grouped.data[k]) - double(own.data[k]), light += double(own.data[k]);
      sum[i] += d, squares[i] += d * d;
    }
  }
  const auto pixels = double(sum.size());
  double z2 = 0, error2 = 0;
  for (size_t i = 0; i < sum.size(); ++i) {
    const double variance = variance_of_sum(sum[i], squares[i], kRuns);
    z2 += sum[i] * sum[i] / variance / pixels;
    error2 += variance * pixels / (light * light);
  }
  return {z2, std::sqrt(error2)};
}

double median_noise(const RenderGroup& render, int members) {
  const Image a = render(members, independent(4, 0)), b = render(members, independent(4, 1));
  std::vector<double> noise;
  for (size_t i = 0; i < a.data.size(); ++i)
    noise.push_back(std::pow(double(a.data[i] - b.data[i]), 2));
  std::nth_element(noise.begin(), noise.begin() + noise.size() / 2, noise.end());
  return noise[noise.size() / 2];
}

void check_bits(const RenderGroup& render, TransportScene& scene) {
  constexpr int kMembers = 16;
  RenderRequest r = batch_request(6, SampleSequence::sobol, 1);
  const Image one = render(kMembers, r);
  for (const int threads : {2, 7}) {
    r.threads = threads;
    CHECK(render(kMembers, r).data == one.data);
  }
  r.pass_seconds = 0;
  CHECK(render(kMembers, r).data == one.data);
  scene.layout.crop = {5, 11, 23, 37};
  const Image window = render(kMembers, r);
  int same = 0;
  const int row = window.width * window.channel_count();
  for (int y = 0; y < window.height; ++y)
    for (int i = 0; i < row; ++i)
      same += window.data[size_t(y * row + i)] ==
              one.data[size_t((y + 11) * one.width * one.channel_count() + 5 * one.channel_count() +
                              i)];
  CHECK(same == window.height * row);
}

}  // namespace duet::test
