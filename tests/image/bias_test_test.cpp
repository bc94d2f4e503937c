#include "image/bias_test.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using namespace duet;

namespace {

constexpr int kBiasSize = 64;

/// A picture with a gradient, a dark part, and light that few samples carry.
struct Synthetic {
  double rare = 0.02;     ///< probability of a bright sample in a spot; elsewhere a twentieth
  double bright = 20;     ///< what it adds
  double deviation = 1;   ///< of the other samples, relative to their mean
  bool filtered = false;  ///< each pixel is the mean of 3×3, as a wide filter makes it

  static double mean_at(int x, int y) { return y < 8 ? 0.002 : 0.2 + 0.8 * x / kBiasSize; }
  static bool in_caustic(int x, int y) { return x >= 24 && x < 36 && y >= 40 && y < 48; }
  /// The mean of n samples of each pixel.
  Image render(int n, std::mt19937& generator, double scale = 1) const {
    Image image(kBiasSize, kBiasSize, {"R", "G", "B"});
    std::normal_distribution<double> normal;
    std::poisson_distribution<int> in_spot(n * rare), elsewhere(0.05 * n * rare);
    for (int y = 0; y < kBiasSize; ++y)
      for (int x = 0; x < kBiasSize; ++x) {
        const double noise = deviation * normal(generator) / std::sqrt(double(n));
        const double value =
            mean_at(x, y) * (1 + noise) +
            (rare > 0 ? bright * (in_caustic(x, y) ? in_spot : elsewhere)(generator) / n : 0.0);
        for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = float(scale * value * (1 + 0.2 * c));
      }
    return filtered ? blurred(image) : image;
  }

  static Image blurred(const Image& image) {
    Image out = image;
    for (int y = 0; y < kBiasSize; ++y)
      for (int x = 0; x < kBiasSize; ++x)
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
              sum += image.pixel((x + dx + kBiasSize) % kBiasSize,
                                 (y + dy + kBiasSize) % kBiasSize)[c];
          out.pixel(x, y)[c] = float(sum / 9);
        }
    return out;
  }
};

/// Mean and variance of one sample from the spread of 32 passes, as references have them.
struct Reference {
  static constexpr int kPasses = 32, kSpp = 128;
  Image mean{kBiasSize, kBiasSize, {"R", "G", "B"}}, variance = mean;
  Reference(const Synthetic& synthetic, unsigned seed) {
    std::mt19937 generator(seed);
    std::vector<double> sums(mean.data.size()), squares(sums);
    for (int pass = 0; pass < kPasses; ++pass) {
      const Image image = synthetic.render(kSpp, generator);
      for (size_t i = 0; i < sums.size(); ++i)
        sums[i] += image.data[i], squares[i] += double(image.data[i]) * image.data[i];
    }
    for (size_t i = 0; i < sums.size(); ++i) {
      const double m = sums[i] / kPasses;
      mean.data[i] = float(m);
      variance.data[i] =
          float(std::max(0.0, squares[i] / kPasses - m * m) * kPasses / (kPasses - 1) * kSpp);
    }
  }
  NoiseModel noise(double spp) const { return {&variance, spp, double(kPasses) * kSpp}; }
  BiasTest test(const Image& image, double spp) const { return test_bias(image, mean, noise(spp)); }
};

void scale(Image& image, int x0, int y0, int size, float factor) {
  for (int y = y0; y < y0 + size; ++y)
    for (int x = x0; x < x0 + size; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] *= factor;
}

}  // namespace

TEST_CASE("at most one unbiased image in a hundred is called biased, however its noise is") {
  const Synthetic normal{.rare = 0}, heavy{}, filtered{.filtered = true};
  // One bright sample in 20,000, a thousand times as bright as the others.
  const Synthetic fireflies{.rare = 0.001, .bright = 1000};
  int which = 0;
  for (const Synthetic& s : {normal, heavy, filtered, fireflies}) {
    CAPTURE(which++);
    int alarms = 0, count = 0, below_half = 0;
    for (unsigned r = 0; r < 2; ++r) {
      const Reference reference(s, r);
      std::mt19937 generator(100 + r);
      for (int i = 0; i < 20; ++i)
        for (const int spp : {16, 256, 1024}) {
          const BiasTest t = reference.test(s.render(spp, generator), spp);
          alarms += t.biased();
          below_half += t.p < 0.5;
          ++count;
        }
    }
    // With a probability of 0.01 each, six or more of 120 happen twice in 1000 tests.
    CHECK(alarms < 6);
    // The p-values are not just large.
    if (&s != &fireflies && s.bright < 100) CHECK(below_half > count / 40);
  }
}

TEST_CASE("planted defects are found") {
  const Synthetic s;
  const Reference reference(s, 1);
  std::mt19937 generator(2);
  constexpr int kCount = 40, spp = 256;
  int dark = 0, tile = 0, caustic = 0, place = 0;
  const Synthetic without{.rare = 0};
  for (int i = 0; i < kCount; ++i) {
    dark += reference.test(s.render(spp, generator, 0.99), spp).biased();
    Image image = s.render(spp, generator);
    scale(image, 48, 24, kBiasSize / 8, 0.9f);
    const BiasTest t = reference.test(image, spp);
    tile += t.biased();
    place += t.tile.x == 48 && t.tile.y == 24;
    caustic += reference.test(without.render(spp, generator), spp).biased();
  }
  CHECK(dark >= 38);
  CHECK(tile >= 38);
  CHECK(place >= 38);
  CHECK(caustic >= 38);
}

TEST_CASE("what the test says it notices, it notices four times in five") {
  const Synthetic s{.rare = 0};
  const Reference reference(s, 3);
  std::mt19937 generator(4);
  int mean = 0, tile = 0;
  const BiasTest t = reference.test(s.render(64, generator), 64);
  for (int i = 0; i < 100; ++i) {
    mean += reference.test(s.render(64, generator, 1 - t.noticed_mean), 64).biased();
    Image image = s.render(64, generator);
    scale(image, 24, 32, kBiasSize / 8, float(1 - t.noticed_tile));
    tile += reference.test(image, 64).biased();
  }
  CHECK(mean >= 65);
  CHECK(mean <= 97);
  CHECK(tile >= 65);
  CHECK(tile <= 97);
  CHECK(t.noticed_tile_worst >= t.noticed_tile);
  CHECK(t.noticed_mean < t.noticed_tile);
}

TEST_CASE("neither a firefly nor light that few samples carry is a bias") {
  const Synthetic s{.rare = 0};
  const Reference reference(s, 5);
  std::mt19937 generator(6);
  Image image = s.render(256, generator);
  CHECK_FALSE(reference.test(image, 256).biased());
  image.pixel(30, 30)[0] = 1e4f;
  CHECK_FALSE(reference.test(image, 256).biased());
  // One sample in 5,000 lights a spot; at four samples per pixel most of a tile goes without it.
  const Synthetic rare{.rare = 0.0002, .bright = 5000};
  const Reference with(rare, 7);
  const Synthetic missed{.rare = 0};
  CHECK_FALSE(with.test(missed.render(4, generator), 4).biased());
  CHECK(with.test(missed.render(16384, generator), 16384).biased());
}

TEST_CASE("noise that is smaller than that of independent samples hides no shift") {
  const Synthetic s{.rare = 0}, calm{.rare = 0, .deviation = 0.2};
  const Reference reference(s, 8);
  std::mt19937 generator(9);
  CHECK_FALSE(reference.test(calm.render(256, generator), 256).biased());
  CHECK(reference.test(calm.render(256, generator, 1.01), 256).biased());
}

TEST_CASE("pixels that share samples") {
  const Synthetic s{.rare = 0, .filtered = true};
  const Reference reference(s, 10);
  std::mt19937 generator(11);
  const BiasTest t = reference.test(s.render(64, generator), 64);
  CHECK(t.correlation > 2.5);  // 9 for large blocks
  // Small windows have tiles of 4×4 pixels, but what hangs together is measured on larger ones.
  const auto window = [](const Image& image) {
    Image part(32, 24, image.channels);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x)
        for (int c = 0; c < 3; ++c) part.pixel(x, y)[c] = image.pixel(x + 16, y + 24)[c];
    return part;
  };
  const Image mean = window(reference.mean), variance = window(reference.variance);
  int alarms = 0;
  for (int i = 0; i < 60; ++i) {
    const Image part = window(s.render(64, generator));
    const BiasTest small = test_bias(part, mean, {&variance, 64, reference.noise(1).reference_spp});
    alarms += small.biased();
    CHECK(small.correlation > 2);
    CHECK(small.tile.width == 4);
  }
  CHECK(alarms < 5);  // of 60 at 0.01, once in 3000 tests
  const Synthetic plain{.rare = 0};
  CHECK(Reference(plain, 12).test(plain.render(64, generator), 64).correlation < 1.5);
}

TEST_CASE("pixels that cannot be judged are left out, and small images have fewer tiles") {
  const Synthetic s;
  Reference reference(s, 13);
  std::mt19937 generator(14);
  Image image = s.render(256, generator);
  scale(image, 24, 40, 8, 0.0f);
  CHECK(reference.test(image, 256).biased());
  for (int y = 40; y < 48; ++y)
    for (int x = 24; x < 32; ++x) reference.variance.pixel(x, y)[1] = 65504;
  image.pixel(0, 0)[2] = NAN;
  const BiasTest t = reference.test(image, 256);
  CHECK_FALSE(t.biased());
  CHECK(t.left_out == 65);

  Image small(5, 3, {"Y"}), variance = small;
  for (float& v : small.data) v = 1;
  for (float& v : variance.data) v = 0.01f;
  const NoiseModel noise{&variance, 16, 1e6};
  CHECK(test_bias(small, small, noise).p == 1);
  CHECK(test_bias(small, small, noise).tests == 9);
  const Image black(kBiasSize, kBiasSize, {"R", "G", "B"});
  CHECK(test_bias(black, black, {&black, 1, 1}).p == 1);
  CHECK_THROWS_AS(test_bias(small, black, noise), std::invalid_argument);
  CHECK_THROWS_AS(test_bias(black, black, noise), std::invalid_argument);
}
