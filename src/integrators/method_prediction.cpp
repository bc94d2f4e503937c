#include "integrators/method_prediction.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "integrators/method_work.h"
#include "integrators/square_histogram.h"
#include "transport/merge_mask.h"

namespace duet {

namespace {

/// Of the squares of contributions: a pilot cannot tell a smaller variance from none at all.
constexpr double kLeastVariance = 0.05;

/// A candidate's techniques for a path over the pilot's.
struct PathRatios {
  /// Of Σ γ n p, which contributions are divided by.
  double density;
  double samples;  ///< of Σ n p, how many contributions there are
  double squares;  ///< of the sum of the squares of the contributions, Σ γ² n p / (Σ γ n p)²
};

PathRatios ratios(const FamilyShares& s, const MethodCandidate& c) {
  double direct = double(s.unidirectional), others = 0;
  if (c.photons_only) {
    if (s.merges > 0) direct = 0, others = c.merges * double(s.first_merge);
  } else {
    others = c.light_paths / PricingRecord::kLightPaths * double(s.light_image) +
             (c.connections ? double(s.connections) : 0.0) + c.merges * double(s.merges);
  }
  const double gain = double(s.gain), mine = double(s.unidirectional), rest = 1 - mine;
  const double density = direct + others;
  return {density, (direct / gain + others) / (mine / gain + rest),
          (direct * gain + others) / (density * density * (mine * gain + rest))};
}

bool is_merge(const PilotSample& v) {
  return v.technique == Technique::first_merge || v.technique == Technique::later_merge;
}

/// How many times the pilot's sample stands for one of an iteration.
double copies(const PilotSample& v) {
  return is_merge(v) ? 1 / PricingRecord::kMergeShare : 1.0;
}

/// Cells of the pilot's image belong to this number squared of tiles.
constexpr int kTilesPerSide = MergeMask::kSide;

size_t tile_of(size_t cell, int side) {
  const size_t y = cell / size_t(side), x = cell % size_t(side);
  return y * kTilesPerSide / size_t(side) * kTilesPerSide + x * kTilesPerSide / size_t(side);
}

/// One over the squares that errors are relative to, by cell.
std::vector<double> normalization(const PricingRecord& r) {
  std::vector<double> cells = r.seen;
  for (const auto* list : {&r.eye, &r.light})
    for (const PilotSample& v : *list) cells[v.cell] += copies(v) * double(v.value);
  const double all = std::accumulate(cells.begin(), cells.end(), 0.0) / double(r.subpaths());
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

/// What one eye sub-path adds up to under a candidate.
struct SubpathSums {
  double connections = 0, connection_squares = 0, merges = 0, merge_squares = 0;
  double blur = 0;  ///< what is too much of the merges
};

class Prediction {
 public:
  Prediction(const PricingRecord& record, const MethodCandidate& candidate, int spp)
      : record_(record),
        candidate_(candidate),
        spp_(spp),
        norms_(normalization(record)),
        tiles_(kTilesPerSide * kTilesPerSide),
        tile_subpaths_(tiles_.size()) {
    for (size_t c = 0; c < norms_.size(); ++c) tile_subpaths_[tile_of(c, record.side)] += 2;
  }

  PredictedMethod run() {
    find_limit();
    add_squares();
    add_subpaths();
    PredictedMethod p;
    const double subpaths = double(record_.subpaths());
    double squares = 0, products = 0, lost = 0, blur_variances = 0;
    // Blur goes with the radius or, where light changes smoothly, with its square.
    const double shrinkage =
        candidate_.merges > 0 ? candidate_.merges / candidate_.light_paths : 0.0;
    for (size_t t = 0; t < tiles_.size(); ++t) {
      const Tile& tile = tiles_[t];
      const double bias =
          tile_subpaths_[t] > 0 ? tile.trimmed * tile.trimmed / tile_subpaths_[t] / subpaths : 0.0;
      const double variance = (tile.squares + tile.products) / subpaths;
      const double blur = tile.blur / subpaths * shrinkage;
      const double blur_variance = tile.blur_squares * std::pow(shrinkage / subpaths, 2);
      p.parts.push_back({all_ > 0 ? tile.missing / all_ : 0, all_ > 0 ? tile.rare / all_ : 0,
                         may_merge_ > 0 ? tile.merged / may_merge_ : 0, variance,
                         variance / spp_ + bias + blur, blur, blur_variance,
                         kLeastVariance * tile.squares / subpaths / spp_ + bias});
      p.missing += p.parts.back().missing, p.rare += p.parts.back().rare;
      p.merged += p.parts.back().merged;
      p.blur += blur, blur_variances += blur_variance;
      squares += tile.squares, products += tile.products, lost += bias;
    }
    p.blur = cautious_blur(p.blur, blur_variances);
    p.variance = std::max(squares + products, kLeastVariance * squares) / subpaths;
    p.error = p.variance / spp_ + lost + p.blur;
    p.cost = predicted_cost(record_, candidate_);
    return p;
  }

 private:
  void find_limit() {
    SquareHistogram spectrum;
    for_each([&](const PilotSample& v, const PathRatios& r) {
      const double square = double(v.square) * norms_[v.cell] / (r.density * r.density);
      spectrum.add(square, copies(v) * r.samples);
    });
    limit_ = spectrum.limit(kTrimmedPixels / spp_ * double(record_.subpaths()));
  }

  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto* list : {&record_.eye, &record_.light})
      for (const PilotSample& v : *list)
        if (const PathRatios r = ratios(v.shares, candidate_); r.density > kLeast) visit(v, r);
  }

  void add_squares() {
    for (const double v : record_.seen) all_ += v;
    for (const auto* list : {&record_.eye, &record_.light})
      for (const PilotSample& v : *list) {
        const double value = copies(v) * double(v.value);
        all_ += value;
        Tile& tile = tiles_[tile_of(v.cell, record_.side)];
        const auto [density, samples, squares] = ratios(v.shares, candidate_);
        if (!(density > kLeast)) {
          tile.missing += value;
          continue;
        }
        if (v.shares.merges > 0) may_merge_ += value;
        const float merges = candidate_.photons_only ? v.shares.first_merge : v.shares.merges;
        tile.merged += value * candidate_.merges * double(merges) / density;
        const double square = double(v.square) * norms_[v.cell];
        if (square / (density * density) > limit_)
          tile.trimmed += value * std::sqrt(norms_[v.cell]), tile.rare += value;
        else
          tile.squares += copies(v) * square * (squares + seen_twice(v.shares, density)) *
                          (v.shared ? candidate_.shared_variance : 1.0);
      }
  }

  /// Where a light vertex both is seen from the camera and merged with what the same pixel sees,
  /// the two come together: twice the square of the first, times the probability of the second,
  /// over what the pilot's contributions add up to. That probability is for an eye vertex anywhere
  /// in a square pixel (1 − exp(−K) is within 0.02 of it), with K the merging area over the
  /// pixel's.
  double seen_twice(const FamilyShares& s, double density) const {
    if (candidate_.photons_only || !(candidate_.merges > 0) || !(s.light_image > 0)) return 0;
    const double seen = candidate_.light_paths / PricingRecord::kLightPaths * double(s.light_image);
    const double merged = candidate_.merges * double(s.first_merge);
    const double direct = double(s.unidirectional), all = direct * double(s.gain) + 1 - direct;
    return 2 * seen / (density * density * all) * -std::expm1(-merged / seen);
  }

  /// Contributions of one sub-path come together: their mean products, less the squared means of
  /// the pixels, which two sub-paths through the same pixel tell.
  void add_subpaths() {
    const double rate = candidate_.merges / PricingRecord::kMergeShare;
    for (size_t w = 0; w + 1 < record_.subpaths(); w += 2) {
      // Sub-paths of the same cell follow each other, cell after cell.
      Tile& tile = tiles_[tile_of(w / 2, record_.side)];
      double& products = tile.products;
      double means[2], blurs[2];
      for (size_t k = 0; k < 2; ++k) {
        const SubpathSums s = subpath(w + k);
        means[k] = s.connections + rate * s.merges;
        blurs[k] = rate * s.blur;
        products += means[k] * means[k] - s.connection_squares - rate * rate * s.merge_squares;
      }
      products -= 2 * means[0] * means[1];
      const double blur = 2 * blurs[0] * blurs[1];
      tile.blur += blur, tile.blur_squares += blur * blur;
    }
  }

  SubpathSums subpath(size_t w) const {
    SubpathSums s;
    for (uint32_t i = w == 0 ? 0 : record_.ends[w - 1]; i < record_.ends[w]; ++i) {
      const PilotSample& v = record_.eye[i];
      const double density = ratios(v.shares, candidate_).density;
      if (!(density > kLeast) || !takes(v)) continue;
      double scaled = double(v.value) * std::sqrt(norms_[v.cell]) / density;
      if (scaled * scaled > limit_) continue;
      if (v.shared) scaled *= std::sqrt(candidate_.shared_variance);
      const double square = scaled * scaled;
      const bool merged = is_merge(v);
      s.blur += scaled * double(v.blur);
      (merged ? s.merges : s.connections) += scaled;
      (merged ? s.merge_squares : s.connection_squares) += square;
    }
    return s;
  }

  /// Whether the candidate has the technique that made the contribution.
  bool takes(const PilotSample& v) const {
    switch (v.technique) {
      case Technique::unidirectional:
        return !candidate_.photons_only || v.shares.merges == 0;
      case Technique::light_image:
        return candidate_.light_paths > 0 && !candidate_.photons_only;
      case Technique::connection:
        return candidate_.connections;
      case Technique::first_merge:
        return candidate_.merges > 0;
      case Technique::later_merge:
        return candidate_.merges > 0 && !candidate_.photons_only;
    }
    return false;
  }

  static constexpr double kLeast = 1e-12;
  const PricingRecord& record_;
  const MethodCandidate& candidate_;
  double spp_;
  std::vector<double> norms_;
  struct Tile {
    double squares = 0, products = 0;  ///< of contributions
    double missing = 0;                ///< light that cannot be found
    double rare = 0;                   ///< light that is left out as too rare
    double trimmed = 0;                ///< the same, in units of the image's error
    double merged = 0;                 ///< light that merging finds
    /// Products of what two sub-paths have too much, and their squares.
    double blur = 0, blur_squares = 0;
  };
  std::vector<Tile> tiles_;
  std::vector<double> tile_subpaths_;
  double limit_ = 0;
  double all_ = 0, may_merge_ = 0;  ///< light, and that of it which could be merged
};

}  // namespace

PredictedMethod predict(const PricingRecord& record, const MethodCandidate& candidate, int spp) {
  return Prediction(record, candidate, spp).run();
}

}  // namespace duet
