#include "integrators/method_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/log.h"
#include "integrators/method_costs.h"
#include "integrators/method_rules.h"

namespace duet {

namespace {

/// Share of the render's cost that the pilot may have, and what one of its eye walks costs in
/// samples of path tracing.
constexpr double kPilotShare = 0.04, kPilotWalkCost = 14;
constexpr int kFewestPixels = 16, kMostPixels = 64;  ///< per side
/// How much better than path tracing a method has to be.
constexpr double kHysteresis = 1.15;
/// Share of the light that may be missed.
constexpr double kNegligible = 1e-4;
/// Share of the pixels that the error leaves out, as `duet compare` does.
constexpr double kTrimmedPixels = 0.001;
/// Of the square of the image's mean, in what errors are relative to.
constexpr double kDarkShare = 0.1;
/// Between the sphere of all surfaces and that of the visible ones: beyond, walks from lights that
/// are far away miss what the image shows.
constexpr double kFarRatio = 30;

/// Squared contributions by their size, in half octaves.
class SquareHistogram {
 public:
  void add(double square, double rate) {
    Bin& b = bins_[index(square)];
    b.squares += square * rate, b.rate += rate;
  }
  /// The square above which contributions are so rare that all of them together happen `rate`
  /// times.
  double limit(double rate) const {
    double sum = 0;
    for (int i = kBins - 1; i >= 0; --i) {
      sum += bins_[size_t(i)].rate;
      if (sum > rate) return std::exp2(0.5 * (i + 1) - kOffset);
    }
    return std::exp2(-kOffset);
  }

 private:
  static constexpr int kBins = 400, kOffset = 100;
  static size_t index(double square) {
    const double i = 2 * (std::log2(std::max(square, 1e-30)) + kOffset);
    return size_t(std::clamp(i, 0.0, double(kBins - 1)));
  }
  struct Bin {
    double squares = 0, rate = 0;
  };
  std::array<Bin, kBins> bins_{};
};

/// The density of a candidate's techniques for a path over that of the pilot's.
double relative_density(const FamilyShares& s, const MethodCandidate& c) {
  return double(s.unidirectional) +
         c.light_paths / PricingRecord::kLightPaths * double(s.light_image) +
         (c.connections ? double(s.connections) : 0.0) + c.merges * double(s.merges);
}

/// How many times the pilot's sample stands for one of an iteration.
double copies(const PricedContribution& v) {
  return v.technique == Technique::merge ? 1 / PricingRecord::kMergeShare : 1.0;
}

/// Cells of the pilot's image belong to this number squared of tiles.
constexpr int kTilesPerSide = 16;

size_t tile_of(size_t cell, int side) {
  const size_t y = cell / size_t(side), x = cell % size_t(side);
  return y * kTilesPerSide / size_t(side) * kTilesPerSide + x * kTilesPerSide / size_t(side);
}

/// One over the squares that errors are relative to, by cell.
std::vector<double> normalization(const PricingRecord& r) {
  std::vector<double> cells = r.seen;
  for (const auto* list : {&r.eye, &r.light})
    for (const PricedContribution& v : *list) cells[v.cell] += copies(v) * double(v.value);
  const double all = std::accumulate(cells.begin(), cells.end(), 0.0) / double(r.walks());
  std::vector<double> tiles(kTilesPerSide * kTilesPerSide), counts(tiles.size());
  for (size_t c = 0; c < cells.size(); ++c) {
    cells[c] /= 2;
    tiles[tile_of(c, r.side)] += cells[c], counts[tile_of(c, r.side)] += 1;
  }
  for (size_t c = 0; c < cells.size(); ++c) {
    const size_t t = tile_of(c, r.side);
    const double mean = std::max(cells[c], tiles[t] / counts[t]);
    cells[c] = 1 / std::max(mean * mean + kDarkShare * all * all, 1e-60);
  }
  return cells;
}

/// What one eye walk adds up to under a candidate.
struct WalkSums {
  double joins = 0, join_squares = 0, merges = 0, merge_squares = 0;
};

class Prediction {
 public:
  Prediction(const PricingRecord& record, const MethodCandidate& candidate, int spp)
      : record_(record),
        candidate_(candidate),
        spp_(spp),
        norms_(normalization(record)),
        trimmed_(kTilesPerSide * kTilesPerSide),
        tile_walks_(trimmed_.size()) {
    for (size_t c = 0; c < norms_.size(); ++c) tile_walks_[tile_of(c, record.side)] += 2;
  }

  PredictedMethod run() {
    find_limit();
    add_squares();
    add_walks();
    PredictedMethod p;
    const double walks = double(record_.walks());
    p.missing = all_ > 0 ? missing_ / all_ : 0;
    p.variance = std::max(squares_ + products_, 0.0) / walks;
    double lost = 0;
    for (size_t t = 0; t < trimmed_.size(); ++t)
      if (tile_walks_[t] > 0) lost += trimmed_[t] * trimmed_[t] / tile_walks_[t];
    p.error = p.variance / spp_ + lost / walks;
    p.cost = cost();
    return p;
  }

 private:
  void find_limit() {
    SquareHistogram spectrum;
    for_each([&](const PricedContribution& v, double density) {
      const double square = double(v.square) * norms_[v.cell] / (density * density);
      spectrum.add(square, copies(v) * density);
    });
    limit_ = spectrum.limit(kTrimmedPixels / spp_ * double(record_.walks()));
  }

  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto* list : {&record_.eye, &record_.light})
      for (const PricedContribution& v : *list)
        if (const double density = relative_density(v.shares, candidate_); density > kLeast)
          visit(v, density);
  }

  void add_squares() {
    for (const double v : record_.seen) all_ += v;
    for (const auto* list : {&record_.eye, &record_.light})
      for (const PricedContribution& v : *list) {
        const double value = copies(v) * double(v.value);
        all_ += value;
        const double density = relative_density(v.shares, candidate_);
        if (!(density > kLeast)) {
          missing_ += value;
          continue;
        }
        const double square = double(v.square) * norms_[v.cell];
        if (square / (density * density) > limit_)
          trimmed_[tile_of(v.cell, record_.side)] += value * std::sqrt(norms_[v.cell]);
        else
          squares_ += copies(v) * square / density;
      }
  }

  /// Contributions of one walk come together: their mean products, less the squared means of the
  /// pixels, which two walks through the same pixel tell.
  void add_walks() {
    const double rate = candidate_.merges / PricingRecord::kMergeShare;
    for (size_t w = 0; w + 1 < record_.walks(); w += 2) {
      double means[2];
      for (size_t k = 0; k < 2; ++k) {
        const WalkSums s = walk(w + k);
        means[k] = s.joins + rate * s.merges;
        products_ += means[k] * means[k] - s.join_squares - rate * rate * s.merge_squares;
      }
      products_ -= 2 * means[0] * means[1];
    }
  }

  WalkSums walk(size_t w) const {
    WalkSums s;
    for (uint32_t i = w == 0 ? 0 : record_.ends[w - 1]; i < record_.ends[w]; ++i) {
      const PricedContribution& v = record_.eye[i];
      const double density = relative_density(v.shares, candidate_);
      if (!(density > kLeast) || !takes(v)) continue;
      const double scaled = double(v.value) * std::sqrt(norms_[v.cell]) / density;
      const double square = scaled * scaled;
      if (square > limit_) continue;
      const bool merged = v.technique == Technique::merge;
      (merged ? s.merges : s.joins) += scaled;
      (merged ? s.merge_squares : s.join_squares) += square;
    }
    return s;
  }

  /// Whether the candidate has the technique that made the contribution.
  bool takes(const PricedContribution& v) const {
    switch (v.technique) {
      case Technique::unidirectional:
        return true;
      case Technique::light_image:
        return candidate_.light_paths > 0;
      case Technique::connection:
        return candidate_.connections;
      case Technique::merge:
        return candidate_.merges > 0;
    }
    return false;
  }

  double cost() const {
    const double walks = double(record_.walks());
    const MethodCandidate& c = candidate_;
    WorkPerSample w;
    w.eye_rays = double(record_.eye_counters.closest_rays) / walks;
    w.light_samples = double(record_.eye_counters.shadow_rays) / walks;
    if (c.light_paths == 0) return path_cost(w);
    w.light_rays = c.light_paths * double(record_.light_counters.closest_rays) / walks;
    w.camera_rays = c.light_paths * double(record_.light_counters.shadow_rays) / walks;
    if (c.connections) {
      const ConnectionCounters& n = record_.connection_counters.connections;
      w.connections = double(n.attempted()) / walks;
      w.connection_rays = double(record_.connection_counters.shadow_rays) / walks;
    }
    if (c.merges > 0) {
      w.merge_queries = double(record_.merge_counters.merge_queries) / walks;
      w.merges = c.light_paths * double(record_.merge_counters.merges) /
                 (walks * PricingRecord::kMergeShare);
    }
    if (c.connections || c.merges > 0)
      w.stored_vertices = c.light_paths * record_.light_vertices / walks;
    return bidirectional_cost(w);
  }

  static constexpr double kLeast = 1e-12;
  const PricingRecord& record_;
  const MethodCandidate& candidate_;
  double spp_;
  std::vector<double> norms_, trimmed_, tile_walks_;
  double limit_ = 0;
  double squares_ = 0, products_ = 0, missing_ = 0, all_ = 0;
};

/// Mean over the iterations of the first merging area over theirs: the radius shrinks.
double mean_shrinkage(double alpha, int iterations) {
  double sum = 0;
  int counted = 0;
  for (int i = 1; i <= iterations; i += 1 + i / 16, ++counted) sum += std::pow(i, 1 - alpha);
  return sum / std::max(1, counted);
}

BidirectionalIntegratorDescription bidirectional(const AutoIntegratorDescription& o,
                                                 BidirectionalMethod method, double light_paths,
                                                 int connections) {
  BidirectionalIntegratorDescription d;
  d.method = method;
  d.max_depth = o.max_depth;
  d.rr_depth = o.rr_depth;
  d.hide_emitters = o.hide_emitters;
  d.strict_normals = o.strict_normals;
  d.light_paths = light_paths;
  d.connections = connections;
  return d;
}

std::vector<MethodCandidate> candidates(const MethodRules& rules,
                                        const AutoIntegratorDescription& o, int spp) {
  using enum BidirectionalMethod;
  std::vector<MethodCandidate> list;
  list.push_back(
      {PathIntegratorDescription{o.max_depth, o.rr_depth, o.hide_emitters, o.strict_normals},
       "path"});
  const auto text = [](double light_paths) { return fmt::format("light_paths={:g}", light_paths); };
  for (const double light : {1 / 16.0, 1 / 4.0, 1.0})
    for (const int connections : {-1, 0})
      list.push_back({bidirectional(o, bdpt, light, connections),
                      "bdpt " + text(light) + (connections == 0 ? " connections=0" : ""), light,
                      connections != 0});
  if (!rules.may_merge) return list;
  for (const double light : {1 / 4.0, 1.0})
    list.push_back({bidirectional(o, vcm, light, -1), "vcm " + text(light), light, true,
                    light / mean_shrinkage(0.75, spp)});
  return list;
}

/// Whether most of the scene lies far from what the camera sees.
bool shows_little(const Scene& scene, Point2i film) {
  constexpr int kRays = 32;
  Bounds seen;
  for (int y = 0; y < kRays; ++y)
    for (int x = 0; x < kRays; ++x) {
      const Point2f at{(float(x) + 0.5f) / kRays * float(film.x),
                       (float(y) + 0.5f) / kRays * float(film.y)};
      const Ray ray = scene.camera->sample_ray(at, {0.5f, 0.5f});
      Hit hit;
      if (scene.accel->closest_hit(ray, hit)) seen.extend(scene.surface(ray, hit).position);
    }
  return !seen.empty() && scene.accel->bounds().radius() > kFarRatio * double(seen.radius());
}

MethodChoice without_pilot(const AutoIntegratorDescription& o, const std::string& why) {
  return {PathIntegratorDescription{o.max_depth, o.rr_depth, o.hide_emitters, o.strict_normals},
          "path: " + why, ""};
}

}  // namespace

PredictedMethod predict(const PricingRecord& record, const MethodCandidate& candidate, int spp) {
  return Prediction(record, candidate, spp).run();
}

MethodPrices price_methods(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook) {
  PricingPlan plan;
  plan.film = outlook.film;
  plan.max_depth = options.max_depth;
  plan.rr_depth = options.rr_depth;
  plan.hide_emitters = options.hide_emitters;
  plan.strict_normals = options.strict_normals;
  plan.threads = outlook.threads;
  const double samples = double(outlook.film.x) * outlook.film.y * outlook.spp;
  const double pixels = kPilotShare * samples / (2 * kPilotWalkCost);
  plan.pixels_per_side = std::clamp(int(std::sqrt(pixels)), kFewestPixels, kMostPixels);
  const PricingRecord record = run_pricing_pilot(scene, plan);
  MethodPrices prices;
  prices.candidates = candidates(method_rules(scene.features), options, outlook.spp);
  prices.walks = record.walks();
  for (const MethodCandidate& c : prices.candidates)
    prices.predictions.push_back(predict(record, c, outlook.spp));
  return prices;
}

MethodChoice choose_method(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook) {
  if (scene.features.media > 0) {
    VolumePathIntegratorDescription through_media;
    through_media.max_depth = options.max_depth;
    through_media.rr_depth = options.rr_depth;
    through_media.hide_emitters = options.hide_emitters;
    through_media.strict_normals = options.strict_normals;
    return {through_media, "volpath: walks from lights do not enter media", ""};
  }
  const MethodRules rules = method_rules(scene.features);
  if (!rules.has_lights) return without_pilot(options, "the scene has no lights");
  if (options.max_depth >= 0 && options.max_depth < 2)
    return without_pilot(options, "paths of one segment are seen directly");
  if (!scene.camera->connectible())
    return without_pilot(options, "the sensor cannot be joined with walks from lights");
  if (rules.far_lights_only && !rules.needs_light_walks && shows_little(scene, outlook.film))
    return without_pilot(options, "walks from lights so far away would miss what the image shows");

  const MethodPrices prices = price_methods(scene, options, outlook);
  const std::vector<MethodCandidate>& c = prices.candidates;
  const std::vector<PredictedMethod>& p = prices.predictions;
  double least_missing = 1;
  for (const PredictedMethod& q : p) least_missing = std::min(least_missing, q.missing);
  const auto covers = [&](size_t i) {
    return p[i].missing <= least_missing + kNegligible &&
           !(rules.needs_light_walks && c[i].light_paths == 0);
  };
  const auto price = [&](size_t i) { return p[i].error * p[i].cost; };
  size_t best = c.size();
  for (size_t i = 0; i < c.size(); ++i) {
    log::detail(
        "auto: {:36} misses {:.2e}, variance {:.3g}, error² {:.3g}, cost {:.3g}, price {:.3g}",
        c[i].name, p[i].missing, p[i].variance, p[i].error, p[i].cost, price(i));
    if (covers(i) && (best == c.size() || price(i) < price(best))) best = i;
  }
  if (covers(0) && !(price(0) > kHysteresis * price(best))) best = 0;
  bool covered_unbiased = false;
  for (size_t i = 0; i < c.size(); ++i) covered_unbiased |= covers(i) && c[i].merges == 0;

  MethodChoice choice;
  choice.method = c[best].method;
  choice.reason = c[best].name + ": ";
  if (!covers(0))
    choice.reason += p[0].missing > kNegligible
                         ? fmt::format("path would miss {:.2g} % of the light", 100 * p[0].missing)
                         : "path cannot find all light";
  else if (best == 0)
    choice.reason += "no other method promises more than 1.15 times its efficiency";
  else
    choice.reason += fmt::format("{:.2g} times the efficiency of path", price(0) / price(best));
  choice.reason += fmt::format(", by a pilot of {} eye walks; {}", prices.walks, describe(rules));
  if (c[best].merges > 0) {
    choice.bias = covered_unbiased ? "merging is consistent, but biased"
                                   : "some light is found by merging only: consistent, but biased";
    choice.reason += "; consistent, biased";
  }
  return choice;
}

}  // namespace duet
