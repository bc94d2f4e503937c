// What exact sums of a film cost, with a gaussian filter, against sums in double precision.
//
//     film SCENE.xml [SPP] [ROUNDS]
//
// Prints processor time per sample: of `path` on the scene at 512x512, of adding the samples to the
// film, in batches and one by one, and of the sums alone, exact and in double precision, in the
// same loops. Exit code 1 if exact sums cost more than 3 % of the time with the others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "cpu_time.h"
#include "image/batch_adder.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"
#include "math/hash.h"
#include "mitsuba/mitsuba.h"
#include "scene/build.h"

using namespace duet;

namespace {

/// Nanoseconds of processor time per sample: the least that was seen.
struct Least {
  double ns = INFINITY;

  template <class Work>
  void time(double samples, Work work) {
    const double start = cpu_seconds();
    work();
    ns = std::min(ns, (cpu_seconds() - start) * 1e9 / samples);
  }
};

/// What sums in double precision would be.
struct DoubleSums {
  alignas(64) double sums[kMostBatchPixels] = {};

  struct Lane {
    double sum;
    [[gnu::always_inline]] void add(double x) { sum += x; }
  };
  [[gnu::always_inline]] Lane lane(int i) const { return {sums[i]}; }
  [[gnu::always_inline]] void set(int i, const Lane& lane) { sums[i] = lane.sum; }
};

constexpr int kReach = 2, kWeights = 2 * kReach + 1;

DUET_WIDEST void add_exact(const BatchFootprints& batch, BatchSums<ExactBatchSums>& sums) {
  add_batch<kWeights>(batch, true, sums);
}
DUET_WIDEST void add_doubles(const BatchFootprints& batch, BatchSums<DoubleSums>& sums) {
  add_batch<kWeights>(batch, true, sums);
}

/// A sample at a random place of each pixel of a tile, and black to bright colours.
struct Samples {
  PixelBounds square{16, 16, 32, 32};
  BatchArray<float> x{}, y{}, r{}, g{}, b{}, alpha{};

  Samples() {
    for (int i = 0; i < kBatch; ++i) {
      const auto random = [&](uint32_t k) { return to_unit_float(mix32(8 * uint32_t(i) + k)); };
      x[i] = float(square.x0 + i % 16) + random(0), y[i] = float(square.y0 + i / 16) + random(1);
      r[i] = 4 * random(2), g[i] = random(3), b[i] = 1e-3f * random(4);
      alpha[i] = 1;
    }
  }
};

/// How long sums alone take.
class Sums {
 public:
  Sums() : exact_sums_(std::make_unique<BatchSums<ExactBatchSums>>()) {
    batch_->reach_x = batch_->reach_y = kReach;
    for (int row = 0; row < 16; ++row)
      for (int column = 0; column < 16; ++column) {
        const int i = batch_->index(column, row), sample = row * 16 + column;
        for (int k = 0; k < kWeights; ++k)
          batch_->weights_x[k][i] = batch_->weights_y[k][i] = 0.3f / float(1 + std::abs(k - 2));
        batch_->colours[0][i] = double(samples_.r[sample]);
        batch_->colours[1][i] = double(samples_.g[sample]);
        batch_->colours[2][i] = double(samples_.b[sample]);
      }
    for (auto* s : {&exact_sums_->opaque_weight, &exact_sums_->colours[0], &exact_sums_->colours[1],
                    &exact_sums_->colours[2]})
      std::fill(std::begin(s->coarse), std::end(s->coarse), ExactBatchSums::kCoarse);
  }

  void run() {
    constexpr int kTimes = 300;
    exact.time(kTimes * kBatch, [&] {
      for (int i = 0; i < kTimes; ++i) add_exact(*batch_, *exact_sums_);
    });
    doubles.time(kTimes * kBatch, [&] {
      for (int i = 0; i < kTimes; ++i) add_doubles(*batch_, *double_sums_);
    });
  }

  Least exact, doubles;

 private:
  Samples samples_;
  std::unique_ptr<BatchFootprints> batch_ = std::make_unique<BatchFootprints>();
  std::unique_ptr<BatchSums<ExactBatchSums>> exact_sums_;
  std::unique_ptr<BatchSums<DoubleSums>> double_sums_ = std::make_unique<BatchSums<DoubleSums>>();
};

/// How long it takes to add samples to a tile.
class Adders {
 public:
  Adders() : film_({{48, 48}, {0, 0, 48, 48}, {}}, {"R", "G", "B", "A"}) {}

  void run() {
    constexpr int kTimes = 64;
    FilmTile& tile = film_.tiles()[4];
    batches.time(kTimes * kBatch, [&] {
      BatchAdder sums(film_, tile, samples_.square);
      for (int i = 0; i < kTimes; ++i)
        sums.add({samples_.x, samples_.y, samples_.r, samples_.g, samples_.b, samples_.alpha});
    });
    one_by_one.time(kTimes * kBatch, [&] {
      SampleAdder sums(film_, tile);
      for (int i = 0; i < kTimes; ++i)
        for (int k = 0; k < kBatch; ++k)
          sums.add(samples_.square.x0 + k % 16, samples_.square.y0 + k / 16,
                   {samples_.x[k], samples_.y[k]},
                   std::array{samples_.r[k], samples_.g[k], samples_.b[k], samples_.alpha[k]});
    });
  }

  Least batches, one_by_one;

 private:
  Film film_;
  Samples samples_;
};

/// Renders the scene with `path`.
class Path {
 public:
  Path(const std::string& scene, int spp) {
    Diagnostics diagnostics;
    auto file = read_mitsuba(scene, {}, diagnostics);
    if (file) {
      apply_override(file->description.integrator, {"path", {}, {}});
      integrator_ = make_integrator(file->description.integrator);
      FilmDescription& film = file->description.sensors.at(0).film;
      film.width = film.height = kSize;
      scene_ = build_scene(std::move(file->description), {}, diagnostics);
    }
    for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", d.to_string());
    request_.budget.spp = spp;
    request_.threads = 1;
  }
  bool can_run() const { return scene_ != nullptr; }

  void run() {
    for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
      FilmLayout layout{{kSize, kSize}, {0, 0, kSize, kSize}, {}};
      layout.filter.kind = kind;
      (kind == FilterKind::box ? box : gaussian)
          .time(double(kSize) * kSize * request_.budget.spp.value_or(1),
                [&] { render(*scene_, *integrator_, layout, request_); });
    }
  }

  Least box, gaussian;

 private:
  static constexpr int kSize = 512;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Integrator> integrator_;
  RenderRequest request_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    fmt::print(stderr, "usage: film SCENE.xml [SPP] [ROUNDS]\n");
    return 2;
  }
  const int spp = argc > 2 ? std::stoi(argv[2]) : 16, rounds = argc > 3 ? std::stoi(argv[3]) : 5;
  Path path(argv[1], spp);
  if (!path.can_run()) return 2;
  Adders adders;
  Sums sums;
  for (int i = 0; i < rounds; ++i) path.run(), adders.run(), sums.run();
  const double extra = sums.exact.ns - sums.doubles.ns,
               ratio = path.gaussian.ns / (path.gaussian.ns - extra);
  fmt::print("ns per sample\n");
  fmt::print("path, box filter                {:7.1f}\n", path.box.ns);
  fmt::print("path, gaussian                  {:7.1f}\n", path.gaussian.ns);
  fmt::print("the film alone, in batches      {:7.1f}\n", adders.batches.ns);
  fmt::print("the film alone, one by one      {:7.1f}\n", adders.one_by_one.ns);
  fmt::print("sums alone, exact               {:7.1f}\n", sums.exact.ns);
  fmt::print("sums alone, double precision    {:7.1f}\n", sums.doubles.ns);
  fmt::print("path with exact sums / with sums in double precision: {:.3f}\n", ratio);
  return ratio <= 1.03 ? 0 : 1;
}
