#include "integrators/group_pilot.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "image/film.h"
#include "integrators/method_prediction.h"
#include "integrators/path.h"
#include "integrators/wide_tracer.h"

namespace duet {

namespace {

constexpr uint64_t kSeed = 0x67726f757073ull;
constexpr int kSide = Film::kTileSize;
constexpr uint32_t kSamples = 2;  ///< of each pixel: as many as a variance needs
/// Pixels of the pricing pilot for each tile of this one, which takes a sixth of its time then.
constexpr int kPilotPixelsPerTile = 128;
constexpr int kFewestTiles = 4;

constexpr size_t kSizes = kAutoPixelGroups.size();

/// Of one pixel: the squared differences of its two samples, without and with groups.
struct PixelPairs {
  double own;
  std::array<double, kSizes> grouped;
  double least_mean;  ///< the least of the means of two samples
};

/// Of a tile.
struct TileResult {
  std::vector<PixelPairs> pixels;
  double sum = 0;  ///< of the samples
  RenderCounters own;
  std::array<RenderCounters, kSizes> grouped;
};

PathIntegratorDescription description(const PathLimits& limits, int group) {
  PathIntegratorDescription d{limits};
  d.pixel_group = group;
  return d;
}

/// The same samples of a tile with all tracers.
class TileTrial {
 public:
  TileTrial(const WideScene& scene, const PricingPlan& plan)
      : scene_(scene.scene),
        film_(plan.film),
        sampler_(SampleSequence::independent, kSeed ^ plan.seed, 0),
        own_(scene, description(plan, 1)) {
    for (size_t g = 0; g < kSizes; ++g)
      grouped_[g] = std::make_unique<WideTracer>(scene, description(plan, kAutoPixelGroups[g]));
  }

  void run(Point2i corner, TileResult& out) {
    const int width = std::min(kSide, film_.x - corner.x);
    const int count = width * std::min(kSide, film_.y - corner.y);
    BatchArray<uint64_t> keys{};
    std::vector<uint64_t> numbers;
    for (int i = 0; i < count; ++i) {
      const uint64_t y = uint64_t(corner.y + i / width), x = uint64_t(corner.x + i % width);
      numbers.push_back(y * uint64_t(film_.x) + x);
      keys[i] = sampler_.pixel_key(numbers.back());
    }
    own_.enter(numbers);
    for (auto& tracer : grouped_) tracer->enter(numbers);
    using Samples = std::array<WideSamples, kSamples>;
    Samples own{};
    std::array<Samples, kSizes> grouped{};
    for (uint32_t s = 0; s < kSamples; ++s) {
      const int n = start({corner, width, count, s}, keys);
      own_.trace(n, sampler_, own[s], out.own);
      for (size_t g = 0; g < kSizes; ++g)
        grouped_[g]->trace(n, sampler_, grouped[g][s], out.grouped[g]);
    }
    for (int i = 0; i < count; ++i) {
      PixelPairs pixel{squared_difference(own, i), {}, mean(own, i)};
      for (size_t g = 0; g < kSizes; ++g) {
        pixel.grouped[g] = squared_difference(grouped[g], i);
        pixel.least_mean = std::min(pixel.least_mean, mean(grouped[g], i));
      }
      out.pixels.push_back(pixel);
      for (const WideSamples& w : grouped.back()) out.sum += grey(w, i);
    }
  }

 private:
  static double grey(const WideSamples& w, int i) {
    return (double(w.r[i]) + double(w.g[i]) + double(w.b[i])) / 3;
  }
  static double mean(const std::array<WideSamples, kSamples>& samples, int i) {
    return (grey(samples[0], i) + grey(samples[1], i)) / 2;
  }
  static double squared_difference(const std::array<WideSamples, kSamples>& samples, int i) {
    return std::pow(grey(samples[0], i) - grey(samples[1], i), 2);
  }

  struct Tile {
    Point2i corner;
    int width, count;
    uint32_t sample;
  };

  /// Begins the paths of a sample in both; returns how many there are.
  int start(const Tile& t, const BatchArray<uint64_t>& keys) {
    const Camera& camera = *scene_.camera;
    BatchKeys batch{};
    sampler_.start_sample(t.sample, t.count, keys, batch);
    BatchArray<float> x{}, y{}, lens_x{}, lens_y{};
    sampler_.numbers_2d(t.count, batch, 0, x, y);
    if (camera.has_lens()) sampler_.numbers_2d(t.count, batch, kLensDimension, lens_x, lens_y);
    int n = 0;
    for (int i = 0; i < t.count; ++i) {
      const Point2f film{x[i] + float(t.corner.x + i % t.width),
                         y[i] + float(t.corner.y + i / t.width)};
      const CameraRay ray = camera.sample_ray(film, {lens_x[i], lens_y[i]});
      if (ray.weight == 0) continue;
      own_.paths().start(n, i, ray, batch);
      for (auto& tracer : grouped_) tracer->paths().start(n, i, ray, batch);
      ++n;
    }
    return n;
  }

  const Scene& scene_;
  Point2i film_;
  BatchSampler sampler_;
  WideTracer own_;
  std::array<std::unique_ptr<WideTracer>, kSizes> grouped_;
};

/// Corners of tiles that cover the image evenly.
std::vector<Point2i> choose_tiles(const PricingPlan& plan) {
  const int across = (plan.film.x + kSide - 1) / kSide, down = (plan.film.y + kSide - 1) / kSide;
  const int wanted =
      std::max(kFewestTiles, plan.pixels_per_side * plan.pixels_per_side / kPilotPixelsPerTile);
  const int per_side = std::max(1, int(std::lround(std::sqrt(wanted))));
  std::vector<Point2i> corners;
  for (int j = 0; j < std::min(per_side, down); ++j)
    for (int i = 0; i < std::min(per_side, across); ++i)
      corners.push_back({(2 * i + 1) * across / (2 * std::min(per_side, across)) * kSide,
                         (2 * j + 1) * down / (2 * std::min(per_side, down)) * kSide});
  return corners;
}

/// The ratios of the variances, relative to the squared means of the tiles, without the pixels
/// whose own are largest. Pixels that are brighter by all samples, as those at the edges of a lamp,
/// are relative to what they are by the least of these: noise of one kind alone is not.
std::array<double, kSizes> variance_ratios(const std::vector<TileResult>& tiles) {
  double sum = 0, samples = 0;
  for (const TileResult& t : tiles) sum += t.sum, samples += double(kSamples * t.pixels.size());
  const double mean = sum / samples;
  std::vector<PixelPairs> pixels;
  for (const TileResult& t : tiles) {
    const double m = t.sum / double(kSamples * t.pixels.size());
    for (PixelPairs p : t.pixels) {
      const double bright = std::max(m, p.least_mean);
      const double scale = 1 / std::max(bright * bright + kDarkShare * mean * mean, 1e-60);
      p.own *= scale;
      for (double& v : p.grouped) v *= scale;
      pixels.push_back(p);
    }
  }
  std::sort(pixels.begin(), pixels.end(),
            [](const PixelPairs& a, const PixelPairs& b) { return a.own < b.own; });
  const size_t count = pixels.size() - size_t(kTrimmedPixels * double(pixels.size()));
  double own = 0;
  std::array<double, kSizes> ratios{};
  for (size_t i = 0; i < count; ++i) {
    own += pixels[i].own;
    for (size_t g = 0; g < kSizes; ++g) ratios[g] += pixels[i].grouped[g];
  }
  for (double& r : ratios) r = own > 0 ? r / own : 1;
  return ratios;
}

}  // namespace

bool suits_pixel_groups(const Scene& scene, const PathLimits& limits) {
  const bool has_third_segment = limits.max_depth < 0 || limits.max_depth > 2;
  return has_third_segment && scene.features.diffuse > 0 && !scene.needs_media_vertices() &&
         PathIntegrator::suits_groups(scene);
}

GroupGains measure_pixel_groups(const Scene& scene, const PricingPlan& plan) {
  const WideScene wide(scene, WideUse::paths);
  const std::vector<Point2i> corners = choose_tiles(plan);
  std::vector<TileResult> tiles(corners.size());
  parallel_for(corners.size(), plan.threads,
               [&](size_t i) { TileTrial(wide, plan).run(corners[i], tiles[i]); });
  const std::array<double, kSizes> ratios = variance_ratios(tiles);
  GroupGains gains;
  for (size_t g = 0; g < kSizes; ++g) {
    double more = 0, paths = 0;
    for (const TileResult& t : tiles) {
      more += double(t.grouped[g].shadow_rays) - double(t.own.shadow_rays);
      paths += double(kSamples * t.pixels.size());
    }
    gains[g] = {kAutoPixelGroups[g], ratios[g], std::max(0.0, more / paths)};
  }
  return gains;
}

}  // namespace duet
