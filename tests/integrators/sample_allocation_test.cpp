#include "integrators/sample_allocation.h"

#include <doctest/doctest.h>

#include <cmath>

#include "image/sample_adder.h"
#include "integrators/pass.h"
#include "integrators/tile_work.h"

using namespace duet;

namespace {

/// A row of pixels in tiles of 16. Each sample is 1 / p with probability p and else nothing: p is
/// as asked for in the tiles that begin at pixel `from` or behind it, and 1/2 before.
class Sparks final : public Integrator {
 public:
  explicit Sparks(float p, int from = 16) : p_(p), from_(from) {}
  std::vector<std::string> channels() const override { return {"R", "G", "B"}; }
  void render_samples(const Scene&, Film& film, const SampleRange& samples,
                      const PassControl& control, RenderCounters& counters) override {
    const auto work = [&](FilmTile& tile, const TileSamples& own, RenderCounters& c) {
      SampleAdder sums(film, tile);
      const float p = tile.sampled().x0 < from_ ? 0.5f : p_;
      for (int x = tile.sampled().x0; x < tile.sampled().x1; ++x)
        for (uint32_t i = own.first; i < own.first + own.count; ++i) {
          Sampler s(SampleSequence::independent, samples.seed, samples.scramble, uint64_t(x));
          s.start_sample(i);
          const float v = s.next_1d() < p ? 1 / p : 0.0f;
          const float values[3] = {v, v, v};
          sums.add(x, 0, {float(x) + 0.5f, 0.5f}, values);
        }
      c.camera_paths += uint64_t(tile.sampled().width()) * own.count;
    };
    for_each_tile(film, samples, control, TileSplit::by_samples, counters, work);
  }

 private:
  float p_;
  int from_;
};

FilmLayout row(int width) {
  FilterDescription box;
  box.kind = FilterKind::box;
  return {{width, 1}, {0, 0, width, 1}, box};
}

std::vector<Film> films(Sparks& sparks, int width, uint32_t samples) {
  static const Scene no_scene;
  std::vector<Film> result;
  RenderCounters counters;
  for (uint32_t b = 0; b < 8; ++b) {
    Film& film = result.emplace_back(row(width), sparks.channels());
    const SampleRange range{SampleSequence::independent, 3, b, 0, samples, {}};
    sparks.render_pass(no_scene, film, range, {}, counters);
  }
  return result;
}

}  // namespace

TEST_CASE("noisier tiles get more samples, in proportion to the deviation") {
  Sparks sparks(0.1f);  // Variances 1 and 9.
  const std::vector<Film> f = films(sparks, 64, 200);
  const std::vector<double> rates = tile_rates(f);
  REQUIRE(rates.size() == 4);
  CHECK((rates[0] + rates[1] + rates[2] + rates[3]) / 4 == doctest::Approx(1));
  // A twentieth of the mean variance, 7, is added to both.
  const double expected = std::sqrt((9 + 0.35) / (1 + 0.35));
  for (int k = 1; k < 4; ++k) CHECK(rates[k] / rates[0] == doctest::Approx(expected).epsilon(0.1));
}

TEST_CASE("rates have bounds, and there are no samples without noise to tell") {
  Sparks rare(0.0001f);
  for (const double r : tile_rates(films(rare, 160, 2000))) {
    CHECK(r >= 0.25 - 1e-9);
    CHECK(r <= 16 + 1e-9);
  }
  Sparks certain(1);
  const std::vector<Film> f = films(certain, 48, 3);
  const std::vector<double> rates = tile_rates(f);
  CHECK(rates[1] == rates[2]);
  CHECK(rates[0] > rates[1]);
}

TEST_CASE("samples are dealt out without gaps, in the mean as many as asked for") {
  Sparks sparks(0.05f);
  std::vector<Film> f = films(sparks, 64, 8);
  SampleAllocation allocation(f);
  std::vector<uint32_t> next(4, 0);
  uint32_t passes = 0;
  double total = 0;
  for (const uint32_t count : {5u, 3u, 1u, 1u, 40u, 7u}) {
    if (total == 8) allocation.spread();
    SampleRange range;
    for (size_t film = 0; film <= 6; ++film) allocation.next(film, count, range);
    CHECK(range.first == passes);
    passes += range.count;
    total += count;
    double mean = 0;
    for (size_t k = 0; k < 4; ++k) {
      const TileSamples s =
          range.tiles.empty() ? TileSamples{range.first, range.count} : range.tiles[k];
      CHECK(s.first == next[k]);
      CHECK(s.count <= range.count);
      next[k] += s.count;
      mean += next[k] / 4.0;
    }
    CHECK(std::abs(mean - total) <= 0.5);
  }
  CHECK(next[0] < next[1]);
}

TEST_CASE("a film's samples have no say in how many it gets") {
  Sparks sparks(0.05f), calm(0.5f);
  std::vector<Film> f = films(sparks, 64, 8);
  std::vector<Film> other = films(calm, 64, 8);
  const auto dealt = [&](size_t film) {
    SampleAllocation allocation(f);
    allocation.spread();
    SampleRange range;
    allocation.next(film, 100, range);
    std::vector<uint32_t> counts;
    for (const TileSamples& s : range.tiles) counts.push_back(s.count);
    return counts;
  };
  const auto first = dealt(1), second = dealt(5);
  for (size_t b = 0; b < 4; ++b) f[b] = std::move(other[b]);
  CHECK(dealt(1) == first);
  CHECK(dealt(5) != second);
}

TEST_CASE("rendering to a target error is unbiased, and its estimate is honest") {
  // The last tile is a single pixel, whose own samples would decide a lot.
  static const Scene no_scene;
  constexpr int kRuns = 1500, kWidth = 161;
  double sum = 0, squares = 0, estimated = 0, real = 0, samples = 0, mean_samples = 0;
  for (int run = 0; run < kRuns; ++run) {
    Sparks sparks(0.1f, kWidth - 1);
    RenderRequest r;
    r.budget.target_error = 0.1;
    r.seed = uint64_t(run);
    r.sequence = SampleSequence::independent;
    const RenderResult result = render(no_scene, sparks, row(kWidth), r);
    const double pixel = double(result.image.pixel(kWidth - 1, 0)[0]);
    sum += pixel, squares += pixel * pixel;
    for (int x = 0; x < kWidth; ++x)
      real += std::pow(double(result.image.pixel(x, 0)[0]) - 1, 2) / kWidth;
    estimated += std::pow(*result.relative_rmse, 2);
    samples += double(result.counters.camera_paths) / kWidth;
    mean_samples += result.spp;
  }
  const double mean = sum / kRuns;
  const double error = std::sqrt((squares / kRuns - mean * mean) / kRuns);
  CAPTURE(mean);
  CAPTURE(error);
  CHECK(std::abs(mean - 1) < 3.5 * error);
  CHECK(error < 0.008);
  CHECK(estimated / real == doctest::Approx(1).epsilon(0.1));
  CHECK(samples == doctest::Approx(mean_samples).epsilon(0.01));
}
