#include "math/square_tree.h"

#include <algorithm>
#include <cmath>

#include "math/warp.h"

namespace duet {

namespace {

/// Quadrants are divided while they hold so much of all mass and so many records.
constexpr double kLeastMass = 0.01;
constexpr size_t kFewestRecords = 16;

double sum_of(std::span<const SquareTree::Record> records) {
  double sum = 0;
  for (const SquareTree::Record& r : records) sum += double(r.weight);
  return sum;
}

}  // namespace

struct SquareTree::Building {
  double weight, uniform;
  /// Mass of a square `depth` divisions below the whole.
  double mass(std::span<const Record> records, int depth) const {
    return uniform * std::ldexp(1.0, -2 * depth) + (1 - uniform) * sum_of(records) / weight;
  }
};

SquareTree::SquareTree(std::span<Record> records, float uniform) {
  const Building all{sum_of(records), double(uniform)};
  if (records.size() >= kFewestRecords && all.weight > 0) divide(all, records, {0, 0}, 0);
}

uint32_t SquareTree::divide(const Building& all, std::span<Record> records, Point2f corner,
                            int depth) {
  const uint32_t index = uint32_t(nodes_.size());
  nodes_.emplace_back();
  const float half = std::ldexp(0.5f, -depth);
  const auto middle_y = std::partition(records.begin(), records.end(),
                                       [&](const Record& r) { return r.at.y < corner.y + half; });
  const auto left = [&](const Record& r) { return r.at.x < corner.x + half; };
  const auto low = std::partition(records.begin(), middle_y, left);
  const auto high = std::partition(middle_y, records.end(), left);
  const std::array<std::span<Record>, 4> parts{std::span(records.begin(), low),
                                               std::span(low, middle_y), std::span(middle_y, high),
                                               std::span(high, records.end())};
  const double mass = all.mass(records, depth);
  for (uint32_t q = 0; q < 4; ++q) {
    const double part = all.mass(parts[q], depth + 1);
    nodes_[index].share[q] = float(part / mass);
    if (part < kLeastMass || parts[q].size() < kFewestRecords || depth + 1 == kDeepest) continue;
    const Point2f at{corner.x + (q & 1 ? half : 0), corner.y + (q & 2 ? half : 0)};
    const uint32_t child = divide(all, parts[q], at, depth + 1);
    nodes_[index].child[q] = child;
  }
  return index;
}

float SquareTree::density(Point2f p, int divisions) const {
  if (nodes_.empty()) return 1;
  float density = 1;
  for (uint32_t i = 0, level = 1;; ++level) {
    const uint32_t right = p.x >= 0.5f, high = p.y >= 0.5f, q = right + 2 * high;
    density *= 4 * nodes_[i].share[q];
    i = nodes_[i].child[q];
    if (i == 0 || int(level) >= divisions) return density;
    p = {2 * p.x - float(right), 2 * p.y - float(high)};
  }
}

Point2f SquareTree::sample(Point2f u, float& density) const {
  density = 1;
  if (nodes_.empty()) return u;
  Point2f corner{0, 0};
  float side = 1;
  /// Chooses a half by `v`, which becomes what is left of it.
  const auto choose = [](float& v, float first) {
    const bool second = v >= first;
    v = std::min((second ? v - first : v) / (second ? 1 - first : first), kBelowOne);
    return uint32_t(second);
  };
  for (uint32_t i = 0;;) {
    const std::array<float, 4>& s = nodes_[i].share;
    const uint32_t high = choose(u.y, s[0] + s[1]);
    const float row = s[2 * high] + s[2 * high + 1];
    const uint32_t right = choose(u.x, s[2 * high] / row), q = right + 2 * high;
    density *= 4 * s[q];
    side *= 0.5f;
    corner = {corner.x + float(right) * side, corner.y + float(high) * side};
    i = nodes_[i].child[q];
    if (i == 0) return {corner.x + u.x * side, corner.y + u.y * side};
  }
}

}  // namespace duet
