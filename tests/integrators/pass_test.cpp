#include "integrators/pass.h"
#include "integrators/tile_work.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "image/sample_adder.h"
#include "integrators/camera_integrator.h"
#include "integrators/pass_length.h"

using namespace duet;

namespace {

/// Looks at nothing: each sample is a function of its position and of random numbers, so that the
/// machinery around it can be tested without a scene.
class FakeIntegrator final : public Integrator {
 public:
  explicit FakeIntegrator(int milliseconds = 0, float brightness = 1)
      : milliseconds_(milliseconds), brightness_(brightness) {}
  std::vector<std::string> channels() const override { return {"R", "G", "B"}; }
  std::vector<uint32_t> passes;  ///< the samples of each
  void render_samples(const Scene&, Film& film, const SampleRange& samples,
                      const PassControl& control, RenderCounters& counters) override {
    pass_start = std::chrono::steady_clock::now();
    passes.push_back(samples.count);
    for_each_tile(film, samples, control, TileSplit::by_samples, counters,
                  [&](FilmTile& tile, const TileSamples& part, RenderCounters& c) {
                    SampleRange own = samples;
                    own.first = part.first, own.count = part.count;
                    render_tile(film, tile, own, c);
                  });
  }

  std::chrono::steady_clock::time_point pass_start;  ///< of the last pass

 private:
  void render_tile(const Film& film, FilmTile& tile, const SampleRange& range,
                   RenderCounters& counters) const {
    if (milliseconds_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds_));
    const PixelBounds& b = tile.sampled();
    SampleAdder sums(film, tile);
    for (uint32_t i = range.first; i < range.first + range.count; ++i)
      for (int y = b.y0; y < b.y1; ++y)
        for (int x = b.x0; x < b.x1; ++x) {
          Sampler s(range.sequence, range.seed, range.scramble,
                    uint64_t(y) * uint64_t(film.full_size().x) + uint64_t(x));
          s.start_sample(i);
          const Point2f u = s.next_2d();
          const float v = 1 + float(x % 3) + 2 * (s.next_1d() - 0.5f);
          const float values[3] = {v * brightness_, v * u.x * brightness_, brightness_};
          sums.add(x, y, {float(x) + u.x, float(y) + u.y}, values);
        }
    counters.camera_paths += uint64_t(b.width()) * b.height() * range.count;
  }

  int milliseconds_;
  float brightness_;
};

FilmLayout layout(FilterKind kind, PixelBounds crop = {0, 0, 40, 50}) {
  FilterDescription filter;
  filter.kind = kind;
  return {{40, 50}, crop, filter};
}

RenderRequest request(int spp, int threads = 1) {
  RenderRequest r;
  r.budget.spp = spp;
  r.threads = threads;
  r.seed = 9;
  return r;
}

RenderResult render_fake(FakeIntegrator fake, const FilmLayout& film, const RenderRequest& r) {
  static const Scene no_scene;
  return render(no_scene, fake, film, r);
}

}  // namespace

TEST_CASE("the image does not depend on the number of threads") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::lanczos}) {
    const Image one = render_fake(FakeIntegrator(), layout(kind), request(20, 1)).image;
    for (const int threads : {2, 7})
      CHECK(render_fake(FakeIntegrator(), layout(kind), request(20, threads)).image.data ==
            one.data);
    RenderRequest other = request(20, 1);
    other.seed = 10;
    CHECK(render_fake(FakeIntegrator(), layout(kind), other).image.data != one.data);
  }
}

TEST_CASE("a crop window is cut out of the full image bit for bit") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::tent, FilterKind::mitchell}) {
    const Image full = render_fake(FakeIntegrator(), layout(kind), request(12)).image;
    for (const PixelBounds crop : {PixelBounds{5, 7, 29, 33}, {0, 0, 1, 1}, {39, 49, 40, 50}}) {
      const Image cut = render_fake(FakeIntegrator(), layout(kind, crop), request(12)).image;
      REQUIRE(cut.width == crop.width());
      bool equal = true;
      for (int y = 0; y < cut.height; ++y)
        for (int x = 0; x < cut.width; ++x)
          for (int c = 0; c < 3; ++c)
            equal &= cut.pixel(x, y)[c] == full.pixel(x + crop.x0, y + crop.y0)[c];
      CHECK(equal);
    }
  }
}

TEST_CASE("every pixel gets the samples it was promised") {
  for (const int spp : {1, 7, 8, 100}) {
    const RenderResult r = render_fake(FakeIntegrator(), layout(FilterKind::box), request(spp));
    CHECK(r.spp == spp);
    CHECK(r.counters.camera_paths == uint64_t(40 * 50 * spp));
    CHECK(r.image.pixel(3, 3)[2] == 1);
    RenderRequest batches = request(spp);
    batches.budget.target_error = 1e-9;
    const RenderResult b = render_fake(FakeIntegrator(), layout(FilterKind::box), batches);
    CHECK(b.spp == spp);
    CHECK(b.counters.camera_paths == uint64_t(40 * 50 * spp));
  }
}

TEST_CASE("a target for the error does not keep a black image rendering") {
  RenderRequest r = request(1, 2);
  r.budget.spp.reset();
  r.budget.target_error = 1e-3;
  const RenderResult black = render_fake(FakeIntegrator(0, 0), layout(FilterKind::box), r);
  CHECK(!black.relative_rmse);
  CHECK(black.spp >= 8 * 256);
  CHECK(black.spp <= 8 * 512);
}

TEST_CASE("the error estimate matches the error that is really made") {
  // Independent samples of standard deviation 2/√12 in R; in G it is about 0.7; B has none.
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    RenderRequest exact_request = request(6000, 2);
    exact_request.seed = 1;
    const Image exact = render_fake(FakeIntegrator(), layout(kind), exact_request).image;
    RenderRequest r = request(64);
    r.sequence = SampleSequence::independent;
    const auto error = [&](const Image& image) {
      double squares = 0, sum = 0;
      for (size_t i = 0; i < image.data.size(); ++i) {
        squares += std::pow(image.data[i] - exact.data[i], 2);
        sum += exact.data[i];
      }
      return std::sqrt(squares / double(image.data.size())) / (sum / double(image.data.size()));
    };
    const RenderResult sequence = render_fake(FakeIntegrator(), layout(kind), r);
    REQUIRE(sequence.relative_rmse);
    CHECK(!sequence.rmse_is_upper_bound);
    CHECK(*sequence.relative_rmse == doctest::Approx(error(sequence.image)).epsilon(0.1));
    r.budget.target_error = 1e-9;
    const RenderResult batches = render_fake(FakeIntegrator(), layout(kind), r);
    REQUIRE(batches.relative_rmse);
    CHECK(*batches.relative_rmse == doctest::Approx(error(batches.image)).epsilon(0.1));
    // One low-discrepancy sequence is better than its parts let on.
    r.budget.target_error.reset();
    r.sequence = SampleSequence::sobol;
    const RenderResult sobol = render_fake(FakeIntegrator(), layout(kind), r);
    CHECK(sobol.rmse_is_upper_bound);
    CHECK(*sobol.relative_rmse > error(sobol.image));
  }
}

TEST_CASE("a target error stops the render about where it is reached") {
  RenderRequest r = request(100000);
  r.sequence = SampleSequence::independent;
  r.budget.target_error = 0.02;
  const RenderResult result = render_fake(FakeIntegrator(), layout(FilterKind::box), r);
  CHECK(*result.relative_rmse <= 0.02);
  CHECK(*result.relative_rmse > 0.015);
  CHECK(result.spp < 10000);
}

TEST_CASE("a time budget is kept, to within one pass") {
  RenderRequest r;
  r.budget.seconds = 0.3;
  FakeIntegrator integrator(1);
  const Scene no_scene;
  const RenderResult result = render(no_scene, integrator, layout(FilterKind::box), r);
  const std::chrono::duration<double> since =
      std::chrono::steady_clock::now() - integrator.pass_start;
  CHECK(result.seconds >= 0.25);
  // However long the machine took for it, the last pass began within the budget.
  CHECK(result.seconds - since.count() < 0.3);
  CHECK(result.spp > 0);
  CHECK(result.image.pixel(39, 49)[2] == 1);
}

TEST_CASE("cancelling keeps what there is") {
  std::atomic<bool> cancel{false};
  RenderRequest r = request(1000000);
  r.cancel = &cancel;
  int reports = 0;
  r.progress = [&](const RenderProgress& p) {
    CHECK(p.fraction <= 1);
    if (++reports == 3) cancel = true;
  };
  const RenderResult result = render_fake(FakeIntegrator(5), layout(FilterKind::box), r);
  CHECK(result.interrupted);
  CHECK(reports == 3);
  CHECK(result.image.pixel(0, 0)[2] == 1);
}

TEST_CASE("how long passes are changes neither the image nor the estimate of its error") {
  static const Scene no_scene;
  for (const bool adaptive : {false, true}) {
    const auto run = [&](double pass_seconds) {
      FakeIntegrator fake;
      RenderRequest r = request(200);
      r.pass_seconds = pass_seconds;
      if (adaptive) r.budget.target_error = 1e-9;
      const RenderResult result = render(no_scene, fake, layout(FilterKind::gaussian), r);
      CHECK(result.spp == 200);
      return std::pair(result, *std::max_element(fake.passes.begin(), fake.passes.end()));
    };
    const auto [shortest, one] = run(0);
    const auto [longest, many] = run(1e9);
    CHECK(one == 1);
    CHECK(many >= 8);
    CHECK(shortest.image.data == longest.image.data);
    REQUIRE(shortest.relative_rmse);
    CHECK(*shortest.relative_rmse == *longest.relative_rmse);
  }
}

TEST_CASE("passes grow until they last as long as they may") {
  PassLength length(0.5);
  CHECK(length.next(1000, 1e9) == 1);
  for (int samples = 1; samples <= 16; samples *= 2) {
    CHECK(length.next(1000, 1e9) == samples);
    length.took(samples, 0.02 * samples);
  }
  CHECK(length.next(1000, 1e9) == 25);
  CHECK(length.next(7, 1e9) == 7);
  CHECK(length.next(1000, 0.1) == 5);
  CHECK(length.next(1000, -1) == 1);
  length.took(25, 100);
  CHECK(length.next(1000, 1e9) == 1);
}

TEST_CASE("without a sample in every pixel there is no image") {
  for (const bool adaptive : {false, true}) {
    std::atomic<bool> cancel{true};
    RenderRequest r = request(1000);
    if (adaptive) r.budget.target_error = 0.01;
    r.cancel = &cancel;
    const RenderResult none = render_fake(FakeIntegrator(), layout(FilterKind::box), r);
    CHECK(none.interrupted);
    CHECK(none.spp == 0);
    CHECK(none.image.data.empty());
    // Nor if the first pass is cut off in the middle.
    cancel = false;
    r.progress = [&](const RenderProgress&) { cancel = true; };
    const RenderResult some = render_fake(FakeIntegrator(150), layout(FilterKind::box), r);
    CHECK(some.interrupted);
    CHECK(some.spp == 0);
    CHECK(some.image.data.empty());
  }
}

TEST_CASE("an image so far is handed out on demand, and changes nothing") {
  for (const bool adaptive : {false, true}) {
    RenderRequest r = request(64);
    if (adaptive) r.budget.target_error = 1e-9;
    const RenderResult plain = render_fake(FakeIntegrator(), layout(FilterKind::gaussian), r);
    int asked = 0, given = 0;
    r.wants_snapshot = [&] { return ++asked == 2; };
    r.snapshot = [&](const RenderResult& so_far) {
      ++given;
      CHECK(so_far.spp >= 1);
      CHECK(so_far.spp < 64);
      CHECK(so_far.image.pixel(39, 49)[2] == doctest::Approx(1));
    };
    const RenderResult watched = render_fake(FakeIntegrator(), layout(FilterKind::gaussian), r);
    CHECK(given == 1);
    CHECK(watched.image.data == plain.image.data);
  }
}
