#include "integrators/group_pilot.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "image/film.h"
#include "integrators/path.h"
#include "integrators/wide_tracer.h"

namespace duet {

namespace {

constexpr uint64_t kSeed = 0x67726f757073ull;
constexpr int kSide = Film::kTileSize;
constexpr uint32_t kSamples = 2;  ///< of each pixel: as many as a variance needs
/// Pixels of the pricing pilot for each tile of this one, which takes a third of its time then.
constexpr int kPilotPixelsPerTile = 128;
constexpr int kFewestTiles = 4;
/// Share of the pixels with the largest variances that do not count.
constexpr double kTrimmed = 0.001;
/// Of the square of the image's mean, in what variances are relative to.
constexpr double kDarkShare = 0.1;

/// Of one pixel: the squared differences of its two samples, without and with groups.
struct PixelPair {
  double own, grouped;
};

/// Of a tile.
struct TileResult {
  std::vector<PixelPair> pixels;
  double sum = 0;  ///< of the samples
  RenderCounters own, grouped;
};

PathIntegratorDescription description(const PathLimits& limits, int group) {
  PathIntegratorDescription d{limits};
  d.pixel_group = group;
  return d;
}

/// The same samples of a tile with either tracer.
class TileTrial {
 public:
  TileTrial(const WideScene& scene, const PricingPlan& plan)
      : scene_(scene.scene),
        film_(plan.film),
        sampler_(SampleSequence::independent, kSeed ^ plan.seed, 0),
        own_(scene, description(plan, 1)),
        grouped_(scene, description(plan, kAutoPixelGroup)) {}

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
    WideSamples samples[2][kSamples]{};
    for (uint32_t s = 0; s < kSamples; ++s) {
      trace(own_, {corner, width, count, s}, keys, numbers, samples[0][s], out.own);
      trace(grouped_, {corner, width, count, s}, keys, numbers, samples[1][s], out.grouped);
    }
    const auto grey = [](const WideSamples& w, int i) {
      return (double(w.r[i]) + double(w.g[i]) + double(w.b[i])) / 3;
    };
    for (int i = 0; i < count; ++i) {
      const double a = grey(samples[0][0], i), b = grey(samples[0][1], i);
      const double c = grey(samples[1][0], i), d = grey(samples[1][1], i);
      out.pixels.push_back({(a - b) * (a - b), (c - d) * (c - d)});
      out.sum += c + d;
    }
  }

 private:
  struct Tile {
    Point2i corner;
    int width, count;
    uint32_t sample;
  };

  void trace(WideTracer& tracer, const Tile& t, const BatchArray<uint64_t>& keys,
             std::span<const uint64_t> numbers, WideSamples& samples, RenderCounters& counters) {
    BatchKeys batch{};
    sampler_.start_sample(t.sample, t.count, keys, batch);
    BatchArray<float> x{}, y{}, lens_x{}, lens_y{};
    sampler_.numbers_2d(t.count, batch, 0, x, y);
    sampler_.numbers_2d(t.count, batch, kLensDimension, lens_x, lens_y);
    tracer.enter(numbers);
    int n = 0;
    for (int i = 0; i < t.count; ++i) {
      const Point2f film{x[i] + float(t.corner.x + i % t.width),
                         y[i] + float(t.corner.y + i / t.width)};
      const CameraRay ray = scene_.camera->sample_ray(film, {lens_x[i], lens_y[i]});
      if (ray.weight != 0) tracer.paths().start(n++, i, ray, batch);
    }
    tracer.trace(n, sampler_, samples, counters);
  }

  const Scene& scene_;
  Point2i film_;
  BatchSampler sampler_;
  WideTracer own_, grouped_;
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

/// The ratio of the variances, relative to the squared means of the tiles, without the pixels whose
/// own are largest.
double variance_ratio(const std::vector<TileResult>& tiles) {
  double sum = 0;
  std::vector<PixelPair> pixels;
  for (const TileResult& t : tiles)
    sum += t.sum, pixels.insert(pixels.end(), t.pixels.begin(), t.pixels.end());
  const double mean = sum / double(kSamples * pixels.size());
  pixels.clear();
  for (const TileResult& t : tiles) {
    const double m = t.sum / double(kSamples * t.pixels.size());
    const double scale = 1 / std::max(m * m + kDarkShare * mean * mean, 1e-60);
    for (const PixelPair& p : t.pixels) pixels.push_back({p.own * scale, p.grouped * scale});
  }
  std::sort(pixels.begin(), pixels.end(),
            [](const PixelPair& a, const PixelPair& b) { return a.own < b.own; });
  const size_t count = pixels.size() - size_t(kTrimmed * double(pixels.size()));
  double own = 0, grouped = 0;
  for (size_t i = 0; i < count; ++i) own += pixels[i].own, grouped += pixels[i].grouped;
  return own > 0 ? grouped / own : 1;
}

}  // namespace

bool suits_pixel_groups(const Scene& scene, const PathLimits& limits) {
  const bool has_third_segment = limits.max_depth < 0 || limits.max_depth > 2;
  return has_third_segment && scene.features.diffuse > 0 && !scene.needs_media_vertices() &&
         PathIntegrator::suits_groups(scene);
}

GroupGain measure_pixel_groups(const Scene& scene, const PricingPlan& plan) {
  const WideScene wide(scene);
  const std::vector<Point2i> corners = choose_tiles(plan);
  std::vector<TileResult> tiles(corners.size());
  parallel_for(corners.size(), plan.threads,
               [&](size_t i) { TileTrial(wide, plan).run(corners[i], tiles[i]); });
  double more = 0, paths = 0;
  for (const TileResult& t : tiles) {
    more += double(t.grouped.shadow_rays) - double(t.own.shadow_rays);
    paths += double(kSamples * t.pixels.size());
  }
  return {variance_ratio(tiles), std::max(0.0, more / paths)};
}

}  // namespace duet
